// SPDX-License-Identifier: MIT
#include "affine_kernel.h"
#include "fixtures/vulkan_environment.h"
#include "metamarch/vulkan/pipeline_cache.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace metamarch::vulkan {
namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

// Opens the tests' device again and compiles, so that its cache is on disk.
void openAndClose() {
    const Device device(testContext(), std::to_string(testDevice().report().index));
    affineKernel(device, 1);
}

// Gives each test its own cache folder.
class PipelineCacheTest : public testing::Test {
  protected:
    PipelineCacheTest() : cacheHome(std::getenv("XDG_CACHE_HOME")) {
        std::string folder = testing::TempDir() + "metamarch-cache-test-XXXXXX";
        setenv("XDG_CACHE_HOME", mkdtemp(folder.data()), 1);
        const auto& physicalDevice = testContext().physicalDevices()[testDevice().report().index];
        file = pipelineCacheFile(physicalDevice.getProperties()).value();
    }

    ~PipelineCacheTest() override {
        fs::remove_all(std::getenv("XDG_CACHE_HOME"));
        setenv("XDG_CACHE_HOME", cacheHome.c_str(), 1);
    }

    const std::string cacheHome;
    fs::path file;
};

TEST_F(PipelineCacheTest, isSavedUnderItsOwnNameOnly) {
    openAndClose();
    ASSERT_TRUE(fs::exists(file));
    EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), {}), 1); // no temporary file is left
}

TEST_F(PipelineCacheTest, isSavedWithEachNewKernel) {
    const Device device(testContext(), std::to_string(testDevice().report().index));
    EXPECT_FALSE(fs::exists(file)); // nothing has been compiled
    affineKernel(device, 1);
    EXPECT_TRUE(fs::exists(file)); // a program that ends now loses nothing
}

TEST_F(PipelineCacheTest, isReadBack) {
    openAndClose();
    const std::string first = contents(file);
    openAndClose();
    EXPECT_GE(contents(file).size(), first.size());
}

TEST_F(PipelineCacheTest, ignoresDamagedFiles) {
    openAndClose();
    const std::string good = contents(file);
    std::string flipped = good;
    flipped.back() = static_cast<char>(flipped.back() ^ 1);
    for (const std::string& damaged :
         {std::string(), std::string("garbage"), good.substr(0, good.size() - 1), good.substr(0, 30),
          good + "more", flipped, std::string(100000, '\xff')}) {
        std::ofstream(file, std::ios::binary) << damaged;
        openAndClose();
        EXPECT_EQ(contents(file), good);
    }
}

TEST_F(PipelineCacheTest, aFolderThatCannotBeWrittenIsNoError) {
    std::ofstream(file.parent_path()) << "a file where the folder should be";
    EXPECT_NO_THROW(openAndClose());
}

TEST_F(PipelineCacheTest, followsTheXdgRules) {
    const vk::PhysicalDeviceProperties properties;
    const std::string ownCache = std::getenv("XDG_CACHE_HOME");
    const std::string home = std::getenv("HOME");
    setenv("XDG_CACHE_HOME", "relative", 1);
    setenv("HOME", "/home/somebody", 1);
    EXPECT_EQ(pipelineCacheFile(properties)->parent_path(), "/home/somebody/.cache/metamarch");
    unsetenv("HOME");
    EXPECT_EQ(pipelineCacheFile(properties), std::nullopt);
    setenv("HOME", home.c_str(), 1);
    setenv("XDG_CACHE_HOME", ownCache.c_str(), 1);
}

} // namespace
} // namespace metamarch::vulkan
