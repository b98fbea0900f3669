#include "converter/cases/case_plan.hpp"

#include <gtest/gtest.h>

namespace samara {
namespace {

TEST(Closure, IsReadBackFromItsWord) {
    for (int i = 0; i <= static_cast<int>(Closure::other); ++i) {
        const auto closure = static_cast<Closure>(i);
        EXPECT_EQ(closure_of(name_of(closure)), closure) << name_of(closure);
    }
    EXPECT_EQ(closure_of("realizableKE"), Closure::realizable_k_epsilon);
}

TEST(Closure, OfAnotherWordIsAnotherOfOpenFoams) {
    EXPECT_EQ(closure_of("kkLOmega"), Closure::other);
}

TEST(Closure, IsUnsaidWithoutAWord) {
    EXPECT_EQ(closure_of(""), Closure::unsaid);
}

}  // namespace
}  // namespace samara
