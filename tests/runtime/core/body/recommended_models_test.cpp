#include "samara/core/body/recommended_models.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/core/body/body_file.hpp"
#include "support/crafted_hdf5.hpp"
#include "support/expect_error.hpp"
#include "support/known_bodies.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using testing::HasSubstr;

constexpr OpenModels all_open = {.loads = true, .patches = true, .turbulence = true};
const RecommendedModels of_surface = {
    .loads = Loads::surface, .patches = 2, .turbulence = Turbulence::none, .origin = "given"};

/// Returns a body that holds tables and, if asked, the loads of its surface.
Body body_with_tables(bool has_surface_loads = true) {
    Body body = test::rubber_ellipsoid();
    body.tables = test::blunt_tables(body, 2);
    if (has_surface_loads) {
        body.surface_loads =
            SurfaceLoads{body.surface, std::vector(body.surface.vertices.size(), Vector3d::Zero().eval())};
    }
    return body;
}

BodyPhysics chosen(const Body& body, const OpenModels& open, BodyPhysics physics = {}) {
    choose_open_models(body, open, physics);
    return physics;
}

TEST(RecommendedModels, AreWhatABodyIsFlownByWhereNothingIsChosen) {
    Body body = body_with_tables();
    body.recommended = of_surface;
    const BodyPhysics physics = chosen(body, all_open);
    EXPECT_EQ(physics.loads, Loads::surface);
    EXPECT_EQ(physics.patches, 2);
    EXPECT_EQ(physics.turbulence, Turbulence::none);
}

TEST(RecommendedModels, WithoutThemTablesComeBeforeTheLoadsOfTheSurface) {
    Body body = body_with_tables();
    EXPECT_EQ(chosen(body, all_open), BodyPhysics());
    body.tables.reset();
    const BodyPhysics of_its_surface = chosen(body, all_open);
    EXPECT_EQ(of_its_surface.loads, Loads::surface);
    EXPECT_EQ(of_its_surface.patches, 1);
    EXPECT_EQ(of_its_surface.turbulence, Turbulence::table);
    body.surface_loads.reset();
    EXPECT_EQ(chosen(body, all_open).loads, Loads::table);  // whose lack is then an error
}

TEST(RecommendedModels, LeaveWhatIsChosenAndWhatThatNeeds) {
    Body body = body_with_tables();
    body.recommended = of_surface;
    // Loads by table have their own patches and turbulence, not those recommended with the surface's.
    EXPECT_EQ(chosen(body, {.patches = true, .turbulence = true}), BodyPhysics());
    BodyPhysics four;
    four.patches = 4;
    EXPECT_EQ(chosen(body, {.loads = true, .turbulence = true}, four).patches, 4);
    // Both have turbulence; a Reynolds number of the table is had by table loads alone.
    EXPECT_EQ(chosen(body, {.loads = true, .patches = true}).loads, Loads::surface);
    EXPECT_EQ(chosen(body, {.loads = true, .patches = true}).turbulence, Turbulence::table);
    BodyPhysics at_one;
    at_one.table_reynolds_number = 1e4;
    EXPECT_EQ(chosen(body, all_open, at_one).loads, Loads::table);
    body.recommended = RecommendedModels{.turbulence = Turbulence::none};
    EXPECT_EQ(chosen(body, all_open).turbulence, Turbulence::none);
    EXPECT_EQ(chosen(body, {.loads = true, .patches = true}).turbulence, Turbulence::table);
}

TEST(RecommendedModels, AreReadAsTheyWereWritten) {
    const test::TemporaryFolder folder;
    Body body = body_with_tables();
    body.recommended = of_surface;
    write_body_file(folder / "egg.body.h5", body);
    EXPECT_EQ(read_body_file(folder / "egg.body.h5").recommended, of_surface);
}

TEST(RecommendedModels, ThatNoBodyCanHaveAreRejected) {
    const test::TemporaryFolder folder;
    for (const auto& [models, words] : std::vector<std::pair<RecommendedModels, const char*>>{
             {{.loads = Loads::none, .turbulence = Turbulence::none}, "neither of tables nor of the surface"},
             {{.patches = 0}, "0 patches"},
             {{.patches = 33}, "33 patches"},
             {{.turbulence = Turbulence::constant}, "turbulence that its loads do not have"}}) {
        EXPECT_THAT(error_of(models), HasSubstr(words));
        Body body = body_with_tables();
        body.recommended = models;
        write_body_file(folder / "egg.body.h5", body);
        EXPECT_THAT(test::error_of([&] { static_cast<void>(read_body_file(folder / "egg.body.h5")); }),
                    HasSubstr(words));
    }
}

}  // namespace
}  // namespace samara
