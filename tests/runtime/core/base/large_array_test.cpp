#include "samara/core/base/large_array.hpp"

#include <cstdint>
#include <limits>
#include <new>
#include <utility>

#include <gtest/gtest.h>

namespace samara {
namespace {

TEST(LargeArray, HoldsZerosAtTheStartOfACacheLine) {
    const LargeArray<float> array(3'000'001);
    EXPECT_EQ(array.bytes(), 3'000'001U * sizeof(float));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data()) % 64, 0U);
    for (const std::size_t i : {std::size_t{0}, std::size_t{1'234'567}, std::size_t{3'000'000}}) {
        EXPECT_EQ(array.data()[i], 0.0F);
    }
}

TEST(LargeArray, IsEmptyWithoutACount) {
    EXPECT_EQ(LargeArray<double>().data(), nullptr);
    EXPECT_EQ(LargeArray<double>(0).bytes(), 0U);
}

TEST(LargeArray, MovesItsNumbers) {
    LargeArray<double> first(100);
    first.data()[42] = 7.0;
    const LargeArray<double> second = std::move(first);
    EXPECT_EQ(second.data()[42], 7.0);
}

TEST(LargeArray, RefusesMoreThanTheAddressSpace) {
    EXPECT_THROW(LargeArray<double>(std::numeric_limits<std::size_t>::max() / 2), std::bad_alloc);
}

}  // namespace
}  // namespace samara
