#include "samara/core/base/machine_memory.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <new>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;

TEST(MachineMemory, IsSomeAndNotMoreThanAnyMachineHas) {
    EXPECT_GT(available_memory(), 1e6);
    EXPECT_LT(available_memory(), 1e15);
}

TEST(MachineMemory, WithinControlGroupsIsTheLeastOfAllThatHoldTheProcess) {
    const TemporaryFolder root;
    (void)root.file("a/b/memory.max", "3000\n");
    (void)root.file("a/b/memory.current", "1000\n");
    (void)root.file("a/b/memory.stat", "anon 800\nfile 200\n");
    EXPECT_EQ(available_in_control_groups("0::/a/b\n", root.path()), 2200.0);
    (void)root.file("a/memory.max", "5000\n");
    (void)root.file("a/memory.current", "4900\n");
    EXPECT_EQ(available_in_control_groups("0::/a/b\n", root.path()), 100.0);
    (void)root.file("a/memory.max", "max\n");
    EXPECT_EQ(available_in_control_groups("0::/a/b\n", root.path()), 2200.0);
    EXPECT_TRUE(std::isinf(available_in_control_groups("0::/elsewhere\n", root.path())));
    EXPECT_TRUE(std::isinf(available_in_control_groups("", root.path())));
    EXPECT_TRUE(std::isinf(available_in_control_groups("garbage\n\n1:\n", root.path())));
}

TEST(MachineMemory, WithinControlGroupsOfTheFirstVersionIsFoundToo) {
    const TemporaryFolder root;
    (void)root.file("memory/job/memory.limit_in_bytes", "10000\n");
    (void)root.file("memory/job/memory.usage_in_bytes", "9000\n");
    (void)root.file("memory/job/memory.stat", "cache 1\ntotal_cache 500\n");
    const char* membership = "9:name=systemd:/\n4:cpu,memory:/job/inner\n3:cpuset:/job\n0::/\n";
    EXPECT_EQ(available_in_control_groups(membership, root.path()), 1500.0);
}

TEST(MachineMemory, ThatIsNotThereIsRefusedWithWhatToDo) {
    EXPECT_NO_THROW(require_memory(1e6, "the flight", "lower the count"));
    EXPECT_THAT(test::error_of([] { require_memory(1e17, "the flight", "lower the count"); }),
                AllOf(HasSubstr("the flight needs 1e+08 GB of memory, but "),
                      HasSubstr(" GB are free; lower the count")));
}

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
