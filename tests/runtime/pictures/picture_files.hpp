#pragma once

#include <filesystem>

#include <gtest/gtest.h>

#include "samara/core/files/content_hash.hpp"

namespace samara::test {

/// Expects a whole PNG of 2000 x 1300 pixels.
inline void expect_png(const std::filesystem::path& file) {
    const std::string bytes = read_bytes(file);
    ASSERT_GT(bytes.size(), 20000U);
    EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(bytes.substr(16, 8), std::string("\0\0\x07\xd0\0\0\x05\x14", 8));  // 2000, 1300
    EXPECT_EQ(bytes.substr(bytes.size() - 8, 4), "IEND");
}

}  // namespace samara::test
