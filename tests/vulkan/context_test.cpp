// SPDX-License-Identifier: MIT
#include "fixtures/expect_error.h"
#include "fixtures/vulkan_environment.h"
#include "metamarch/vulkan/context.h"
#include "metamarch/vulkan/submission.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

namespace metamarch::vulkan {
namespace {

// Runs in a separate process: the loader reads its environment variables once, and validation messages must
// not count against this process.
class ContextDeathTest : public testing::Test {
  protected:
    void SetUp() override {
        GTEST_FLAG_SET(death_test_style, "threadsafe");
    } // a fork would lack the driver's threads
};

// Exits immediately, so that no sanitizer's leak check changes the exit code.
void exitWithCodeOfContext() {
    try {
        const Context context;
        std::_Exit(0);
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        std::_Exit(error.kind == ErrorKind::noDevice ? 4 : 1);
    }
}

TEST_F(ContextDeathTest, namesThePackageWhenThereIsNoDriver) {
    EXPECT_EXIT(
        {
            setenv("VK_DRIVER_FILES", "/does/not/exist.json", 1);
            setenv("VK_ICD_FILENAMES", "/does/not/exist.json", 1);
            exitWithCodeOfContext();
        },
        testing::ExitedWithCode(4), "mesa-vulkan-drivers");
}

TEST_F(ContextDeathTest, namesThePackageWhenTheValidationLayerIsMissing) {
    EXPECT_EXIT(
        {
            setenv("VK_LAYER_PATH", "/does/not/exist", 1);
            exitWithCodeOfContext();
        },
        testing::ExitedWithCode(4), "vulkan-validationlayers");
}

TEST_F(ContextDeathTest, validationMessagesAreCountedAndPrinted) {
    EXPECT_EXIT(
        {
            // Reads past the end of the buffer.
            const Buffer buffer(testDevice(), BufferUse::storage, 64, "buffer");
            const Buffer readback(testDevice(), BufferUse::readback, 64, "readback");
            Submission(testDevice()).run([&](Commands& commands) {
                commands.copy(buffer, 32, readback, 0, 64);
            });
            std::_Exit(static_cast<int>(validationMessages()));
        },
        testing::ExitedWithCode(1), "validation: .*vkCmdCopyBuffer");
}

} // namespace
} // namespace metamarch::vulkan
