#include "samara/core/dynamics/prepared_bodies.hpp"

#include <gtest/gtest.h>

#include "support/known_bodies.hpp"

namespace samara {
namespace {

TEST(PreparedBodies, ThatDifferInNameAndStartAloneAreOne) {
    const Body body = test::rubber_ellipsoid();
    SceneBody kind = test::scene_body(1200.0);
    kind.loads = Loads::none;
    PreparedBodies prepared;
    const auto first = prepared.get(body, kind, Fluid{}, "body");
    kind.name = "another";
    kind.position = Vector3d(1.0, 2.0, 3.0);
    kind.start = 0.5;
    EXPECT_EQ(prepared.get(body, kind, Fluid{}, "body"), first);
    kind.mass.density = 1300.0;
    EXPECT_NE(prepared.get(body, kind, Fluid{}, "body"), first);
    kind.mass.density = 1200.0;
    EXPECT_NE(prepared.get(body, kind, Fluid{.density = 1.2, .viscosity = 1.8e-5}, "body"), first);
}

TEST(PreparedBodies, KeepAsManyAsTheyAreToldTo) {
    const Body body = test::rubber_ellipsoid();
    SceneBody kind = test::scene_body(1.0);
    kind.loads = Loads::none;
    PreparedBodies few(2);
    PreparedBodies many(30);
    std::vector<std::shared_ptr<const ImmersedBody>> of_few;
    std::vector<std::shared_ptr<const ImmersedBody>> of_many;
    for (int i = 1; i <= 20; ++i) {
        kind.mass.density = 1000.0 + i;
        of_few.push_back(few.get(body, kind, Fluid{}, "body"));
        of_many.push_back(many.get(body, kind, Fluid{}, "body"));
    }
    kind.mass.density = 1001.0;
    EXPECT_NE(few.get(body, kind, Fluid{}, "body"), of_few.front());
    EXPECT_EQ(many.get(body, kind, Fluid{}, "body"), of_many.front());
}

}  // namespace
}  // namespace samara
