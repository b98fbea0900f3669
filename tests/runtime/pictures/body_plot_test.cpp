#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "paths.hpp"
#include "picture_files.hpp"
#include "samara/analysis/verdicts/case_records.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/pictures/body_arcs.hpp"
#include "samara/pictures/body_pictures.hpp"
#include "support/known_bodies.hpp"
#include "support/program_run.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using test::ProgramRun;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Body shipped_body(const std::string& name) {
    return read_body_file(std::filesystem::path(SAMARA_SOURCE_DIRECTORY) / "runtime" / "bodies" /
                          (name + ".body.h5"));
}

Body blunt_body() {
    Body body = test::rubber_ellipsoid();
    body.name = "blunt";
    body.tables = test::blunt_tables(body, 4);
    return body;
}

/// All numbers of a JSON value, and how many are none.
void expect_finite(const nlohmann::json& value, const std::string& place) {
    if (value.is_structured()) {
        for (const auto& [key, part] : value.items()) expect_finite(part, fmt::format("{}/{}", place, key));
    } else if (value.is_number()) {
        EXPECT_TRUE(std::isfinite(value.get<double>())) << place;
    }
}

TEST(BodyPicture, OfEachShippedBodyAndOfOneWithoutCasesAndErrorsHoldsFiniteNumbers) {
    for (const char* name : {"airplane", "cube", "disc", "leaf", "samara", "sphere", "blunt"}) {
        const Body body = name == std::string("blunt") ? blunt_body() : shipped_body(name);
        for (const char* kind : {"polars", "sphere", "convergence"}) {
            expect_finite(body_picture(kind, body), std::string(name) + ' ' + kind);
        }
    }
    EXPECT_EQ(body_picture("sphere", shipped_body("leaf"))["drag"].size(), 120U);
    EXPECT_EQ(body_picture("convergence", blunt_body())["ladders"].size(), 0U);
}

TEST(CaseRecords, AreThoseOfTheBake) {
    const Body leaf = shipped_body("leaf");
    const std::vector<CaseRecord> records = case_records(*leaf.tables);
    ASSERT_EQ(records.size(), 133U);
    const auto found = std::ranges::find(records, "direction_12_wake_laminar", &CaseRecord::name);
    ASSERT_NE(found, records.end());
    EXPECT_NEAR((found->direction - leaf.tables->axes * -Vector3d::UnitX()).norm(), 0.0, 1e-12);
    EXPECT_EQ(found->cells, 39192.0);
    EXPECT_EQ(found->closure, "laminar");
    EXPECT_NEAR(found->drag, 0.18046, 1e-5);
    EXPECT_FALSE(found->k);  // which is that of cases of its own, the last in the list
    EXPECT_GT(records.back().k.value(), 0.0);
    EXPECT_EQ(records.front().mesh_remedy, "as planned");
    EXPECT_EQ(main_reynolds_number(*leaf.tables, records), 3320.0);
    LoadTables other = *leaf.tables;
    for (const char* text :
         {"", "no JSON", "{}", "[1, {\"direction\": [0, 0]}]", "[{\"solved_by\": \"user\"}]"}) {
        other.provenance = text;
        EXPECT_THAT(case_records(other), IsEmpty()) << text;
    }
}

TEST(BodyArcs, AreFewerTheMoreSymmetricTheBodyIs) {
    const auto arcs = [](const char* name) {
        const Body body = shipped_body(name);
        return arcs_of(body, main_reynolds_number(*body.tables, {}));
    };
    EXPECT_EQ(arcs("sphere").size(), 1U);
    EXPECT_EQ(arcs("disc").size(), 2U);
    EXPECT_EQ(arcs("leaf").size(), 3U);
    const auto shown = [&](const char* name) {
        const Body body = shipped_body(name);
        return shown_angle(*body.tables, arcs(name), body.tables->reynolds_numbers.back());
    };
    EXPECT_EQ(shown("sphere"), 90.0);
    EXPECT_EQ(shown("ellipsoid"), 90.0);
    EXPECT_EQ(shown("leaf"), 360.0);
}

TEST(BodyArcs, HaveTheTablesValuesAndTheirErrors) {
    const Body body = blunt_body();
    const BodyArc arc{"x to z", Vector3d::UnitX(), Vector3d::UnitZ()};
    const double angle = 0.4;
    const Vector3d direction(std::cos(angle), 0.0, std::sin(angle));
    const LoadEntry entry = look_up(*body.tables, direction, 1e4);
    const ArcValues values = values_on(*body.tables, arc, angle, 1e4);
    EXPECT_NEAR(values.drag, -entry.force.dot(direction), 1e-14);
    EXPECT_NEAR(values.lift, entry.force.z() * std::cos(angle) - entry.force.x() * std::sin(angle), 1e-14);
    EXPECT_NEAR(values.moment, -entry.moment.y(), 1e-14);
    EXPECT_EQ(values.k, entry.turbulent_kinetic_energy);
}

TEST(BodyArcs, FindASolvedDirectionAndItsImages) {
    const BodyArc arc{"x to z", Vector3d::UnitX(), Vector3d::UnitZ()};
    Symmetry symmetry;
    const Vector3d direction = Vector3d(1.0, 0.0, 1.0).normalized();
    EXPECT_THAT(angles_on(arc, symmetry, direction, 360.0), ElementsAre(testing::DoubleNear(45.0, 1e-9)));
    EXPECT_THAT(angles_on(arc, symmetry, Vector3d(1.0, 0.1, 1.0).normalized(), 360.0), IsEmpty());
    symmetry.elements.emplace_back(Vector3d(1.0, 1.0, -1.0).asDiagonal());
    EXPECT_THAT(angles_on(arc, symmetry, direction, 360.0),
                ElementsAre(testing::DoubleNear(45.0, 1e-9), testing::DoubleNear(315.0, 1e-9)));
    EXPECT_EQ(angles_on(arc, symmetry, direction, 90.0).size(), 1U);
}

/// samara plot on a shipped body and on a motion.
class PlotOfBodies : public testing::Test {
  protected:
    PlotOfBodies() {
        write_body_file(folder_ / "leaf.body.h5", shipped_body("leaf"));
        write_body_file(folder_ / "bare.body.h5", test::rubber_ellipsoid());
        write_motion_file(folder_ / "tumble.h5",
                          test::motion_of([](double t) { return test::tumble(t, 6.0, 0.3); }, 1.0));
    }
    [[nodiscard]] ProgramRun plot(std::vector<std::string> words) const {
        words.insert(words.begin(), {"samara", "plot"});
        return run_program_in(folder_, words);
    }
    test::TemporaryFolder folder_;
};

TEST_F(PlotOfBodies, DrawsPolarsUnlessAskedForAnotherKind) {
    const ProgramRun polars = plot({"leaf.body.h5", "-o", "picture.svg", "--json"});
    ASSERT_EQ(polars.status, 0) << polars.error;
    EXPECT_EQ(polars.json()["kind"], "polars");
    EXPECT_EQ(polars.json()["arcs"], 3);
    const ProgramRun sphere = plot({"leaf.body.h5", "-o", "picture.png", "--kind", "sphere", "--json"});
    ASSERT_EQ(sphere.status, 0) << sphere.error;
    EXPECT_EQ(sphere.json()["cases"], 13);
    EXPECT_EQ(sphere.json()["planned"], 1.0);
    test::expect_png(folder_ / "picture.png");
    const ProgramRun convergence =
        plot({"leaf.body.h5", "-o", "picture.svg", "--kind", "convergence", "--json"});
    ASSERT_EQ(convergence.status, 0) << convergence.error;
    EXPECT_EQ(convergence.json()["directions"], 6);
    EXPECT_EQ(convergence.json()["meshes"], 2);
    EXPECT_EQ(convergence.json()["sources"], 5);
}

TEST_F(PlotOfBodies, RefusesWhatTheFileDoesNotHold) {
    const auto rejected = [&](const std::vector<std::string>& words, const char* text) {
        const ProgramRun done = plot(words);
        EXPECT_EQ(done.status, 1);
        EXPECT_TRUE(test::is_one_line(done.error)) << done.error;
        EXPECT_THAT(done.error, HasSubstr(text));
        EXPECT_FALSE(std::filesystem::exists(folder_ / "no.svg"));
    };
    rejected({"bare.body.h5", "-o", "no.svg"}, "has no tables to draw");
    rejected({"leaf.body.h5", "-o", "no.svg", "--kind", "strip"}, "take polars, sphere or convergence");
    rejected({"tumble.h5", "-o", "no.svg", "--kind", "polars"}, "take strip, phase, landing or forces");
    rejected({"leaf.body.h5", "-o", "no.svg", "--run", "1"}, "applies to a motion");
}

}  // namespace
}  // namespace samara
