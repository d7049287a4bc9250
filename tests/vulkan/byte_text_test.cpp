// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/byte_text.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace metamarch::vulkan {
namespace {

TEST(ByteText, choosesTheLargestUnitBelowTheValue) {
    EXPECT_EQ(byteText(0), "0 bytes");
    EXPECT_EQ(byteText(1023), "1023 bytes");
    EXPECT_EQ(byteText(1024), "1.0 KiB");
    EXPECT_EQ(byteText(uint64_t{128} << 20), "128.0 MiB");
    EXPECT_EQ(byteText((uint64_t{5} << 30) / 2), "2.5 GiB");
    EXPECT_EQ(byteText(UINT64_MAX), "16.0 EiB");
}

} // namespace
} // namespace metamarch::vulkan
