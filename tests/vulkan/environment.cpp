#include "environment.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>

namespace metamarch::vulkan {
namespace {

std::optional<Context> context;
std::optional<Device> device;

// Fails the program when the validation layer had anything to say, up to the very end of the instance.
class VulkanEnvironment : public testing::Environment {
  public:
    void SetUp() override {
        setenv("XDG_CACHE_HOME", (testing::TempDir() + "metamarch-tests").c_str(), 1);
        setenv("METAMARCH_VALIDATION", "1", 1);
        context.emplace();
        device.emplace(*context);
    }

    void TearDown() override {
        device.reset();
        context.reset();
        EXPECT_EQ(validationMessages(), 0u);
    }
};

const testing::Environment* const environment = testing::AddGlobalTestEnvironment(new VulkanEnvironment);

} // namespace

const Context& testContext() { return context.value(); }
const Device& testDevice() { return device.value(); }

} // namespace metamarch::vulkan
