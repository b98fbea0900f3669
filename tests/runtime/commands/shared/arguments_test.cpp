#include "samara/commands/shared/arguments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace samara {
namespace {

TEST(Arguments, AListIsTheWordsBetweenItsCommas) {
    EXPECT_THAT(comma_separated("fall.toml,fall.h5"), testing::ElementsAre("fall.toml", "fall.h5"));
    EXPECT_THAT(comma_separated(",a b,,c,"), testing::ElementsAre("a b", "c"));
    EXPECT_THAT(comma_separated(""), testing::IsEmpty());
}

}  // namespace
}  // namespace samara
