// SPDX-License-Identifier: MIT
#include "fixtures/expect_error.h"
#include "fixtures/temporary_folder.h"
#include "metamarch/bench/ray_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>

namespace metamarch::bench {
namespace {

class RayFile : public testing::Test {
  protected:
    std::filesystem::path write(const std::vector<float>& values, const std::size_t extraBytes = 0) {
        std::filesystem::path path = folder / "rays.bin";
        std::ofstream file(path, std::ios::binary);
        file.write(reinterpret_cast<const char*>(values.data()),
                   static_cast<std::streamsize>(values.size() * sizeof(float)));
        file << std::string(extraBytes, 'x');
        return path;
    }

    void expectRefused(const std::filesystem::path& path, const std::string& part) {
        expectError(ErrorKind::inputRefused, part, [&] { readRayFile(path); });
    }

    TemporaryFolder folder;
};

TEST_F(RayFile, readsOriginAndDirection) {
    const RaySet set = readRayFile(write({1, 2, 3, 4, 5, 6, 7, 8, 9, -1, 0, 0}));
    ASSERT_EQ(set.rays.size(), 2u);
    EXPECT_EQ(set.query, HitQuery::closest);
    EXPECT_EQ(set.rays[0].origin, glm::vec3(1, 2, 3));
    EXPECT_EQ(set.rays[0].dir, glm::vec3(4, 5, 6));
    EXPECT_EQ(set.rays[1].dir, glm::vec3(-1, 0, 0));
    EXPECT_EQ(set.rays[1].tMin, 0.0f);
    EXPECT_EQ(set.rays[1].tMax, kFarthest);
}

TEST_F(RayFile, refusesWhatIsNoFileOfRays) {
    expectRefused(folder / "absent.bin", "absent.bin: no such file");
    expectRefused(folder / "", "no such file");
    expectRefused(write({}), "0 bytes");
    expectRefused(write({1, 2, 3, 4, 5}), "20 bytes");
    expectRefused(write({1, 2, 3, 4, 5, 6}, 1), "25 bytes");
}

TEST_F(RayFile, refusesNumbersThatMakeNoRay) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    expectRefused(write({1, 2, 3, 4, 5, 6, 1, 2, nan, 4, 5, 6}), "ray 1 has a number that is not finite");
    expectRefused(write({1, 2, 3, 4, 5, -infinity}), "ray 0 has a number that is not finite");
    expectRefused(write({1, 2, 3, 0, -0.0f, 0}), "ray 0 has no direction");
}

} // namespace
} // namespace metamarch::bench
