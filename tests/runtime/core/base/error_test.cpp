#include "samara/core/base/error.hpp"

#include <gtest/gtest.h>

#include "support/expect_error.hpp"

namespace samara {
namespace {

TEST(Labelled, PutsTheLabelBeforeAnError) {
    EXPECT_EQ(labelled("a.stl", [] { return 3; }), 3);
    EXPECT_EQ(test::error_of([] { labelled("a.stl", [] { throw Error("is empty"); }); }), "a.stl: is empty");
}

TEST(Naming, PutsTheFileOfTheUserInPlaceOfOneMadeOnTheWay) {
    EXPECT_EQ(naming("a.stl", "/tmp/x/a.body.h5", [] { return 3; }), 3);
    EXPECT_EQ(test::error_of([] {
                  naming("a.stl", "/tmp/x/a.body.h5",
                         [] { throw Error("/tmp/x/a.body.h5: touches itself; look at /tmp/x/a.body.h5"); });
              }),
              "a.stl: touches itself; look at a.stl");
    EXPECT_EQ(test::error_of([] { naming("aaa", "a", [] { throw Error("a b a"); }); }), "aaa b aaa");
}

}  // namespace
}  // namespace samara
