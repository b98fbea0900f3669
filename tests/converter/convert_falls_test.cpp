// Falls beside the cases, and the coefficients that they give.
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "converted_box.hpp"
#include "converter/falls/motion_parameters.hpp"
#include "support/known_bodies.hpp"
#include "synthetic_fall.hpp"

namespace samara {
namespace {

using testing::HasSubstr;
using ConvertFalls = test::ConvertedBox;

void plan_falls(const test::SolvedFolder& folder, const nlohmann::json& falls) {
    folder.change_plan([&](nlohmann::json& plan) { plan["falls"] = falls; });
}

TEST_F(ConvertFalls, LeavesOutAFallThatFailedAndTheBodyWithoutCoefficients) {
    plan_falls(folder_, {{{"name", "fall_00"}, {"mesh", "mesh"}}});
    folder_.write("fall_00/failed.json", R"({"reason": "the solver stopped"})");
    const Conversion conversion = convert_folder(folder_.path());
    EXPECT_FALSE(conversion.identification);
    EXPECT_FALSE(conversion.body.dynamic);
    EXPECT_EQ(conversion.cases.size(), 12U);
    const std::vector<LeftOutCase>& left_out = conversion.left_out;
    ASSERT_EQ(left_out.size(), 1U);
    EXPECT_EQ(left_out[0].name, "fall_00");
    EXPECT_EQ(left_out[0].reason, "the solver stopped");
}

TEST_F(ConvertFalls, LeavesOutAFallWhoseMeshFailed) {
    plan_falls(folder_, {{{"name", "fall_00"}, {"mesh", "mesh_medium"}}});
    folder_.write("mesh_medium/failed.json", R"({"reason": "too few cells"})");
    const Conversion conversion = convert_folder(folder_.path());
    ASSERT_EQ(conversion.left_out.size(), 1U);
    EXPECT_EQ(conversion.left_out[0].reason, "its mesh mesh_medium could not be made: too few cells");
}

TEST_F(ConvertFalls, RejectsAFallThatIsNeitherSolvedNorFailed) {
    plan_falls(folder_, {{{"name", "fall_00"}, {"mesh", "mesh"}}, {{"name", "fall_01"}, {"mesh", "mesh"}}});
    folder_.write("fall_00/failed.json", R"({"reason": "the solver stopped"})");
    EXPECT_EQ(
        error(),
        folder_.path().string() +
            ": the fall fall_01 is not solved; run 'samara bake' again, which continues where it stopped");
}

TEST_F(ConvertFalls, RejectsAFallWithTheNameOfACase) {
    plan_falls(folder_, {{{"name", "case_00"}, {"mesh", "mesh"}}});
    EXPECT_THAT(error(), HasSubstr("plan.json: two cases or falls are named case_00;"));
    plan_falls(folder_, {{{"mesh", "mesh"}}});
    EXPECT_THAT(error(), HasSubstr("plan.json: an entry is missing or of the wrong type"));
}

std::string state_history(const FallRecord& record) {
    std::string text = "# Motion State\n# Time\tcentreOfRotation\tcentreOfMass\trotation\tvelocity\tomega\n";
    for (const FallSample& sample : record.samples) {
        // The angles of the principal axes about x, y and z, applied in this order.
        const Matrix3d axes = sample.rotation * record.fall.principal_axes;
        const Vector3d angles(std::atan2(-axes(1, 2), axes(2, 2)),
                              std::asin(std::clamp(axes(0, 2), -1.0, 1.0)),
                              std::atan2(-axes(0, 1), axes(0, 0)));
        text += fmt::format("{:.12g}", sample.time);
        for (const Vector3d& vector :
             {sample.position, sample.position, angles, sample.velocity, sample.angular_velocity}) {
            text += fmt::format("\t({:.12e} {:.12e} {:.12e})", vector.x(), vector.y(), vector.z());
        }
        text += "\n";
    }
    return text;
}

std::string zero_history(const FallRecord& record) {
    std::string text =
        "# Time\t(total_x total_y total_z)\t(pressure_x pressure_y pressure_z)\t(viscous_x viscous_y "
        "viscous_z)\n";
    for (const FallSample& sample : record.samples) {
        text += fmt::format("{:.12g}\t(0 0 0)\t(0 0 0)\t(0 0 0)\n", sample.time);
    }
    return text;
}

void write_fall(const test::SolvedFolder& folder, const FallRecord& record) {
    const std::string name = record.fall.name;
    folder.write(name + "/fall.json", free_fall_json(record.fall));
    folder.write(name + "/postProcessing/state/0/sixDoFRigidBodyState.dat", state_history(record));
    folder.write(name + "/postProcessing/forces/0/force.dat", zero_history(record));
    folder.write(name + "/postProcessing/forces/0/moment.dat", zero_history(record));
    folder.write(name + "/provenance.json", "{}");
}

// The folder's body is a box; its fall has an ellipsoid's numbers, which matters to no file.
TEST_F(ConvertFalls, IdentifiesTheCoefficientsOfTheFallsThatAreSolved) {
    Body body = test::box_body(Vector3d(0.02, 0.04, 0.08));
    body.kirchhoff = test::rubber_ellipsoid().kirchhoff;
    const test::SolvedFolder folder(body, 2, {1e3, 1e4}, test::box_law_by_reynolds_number);
    const Body with_tables = convert_folder(folder.path()).body;
    FreeFall fall = test::oblique_fall(with_tables, 10.0);
    const MotionParameters parameters(with_tables);
    const DynamicCoefficients expected = parameters.coefficients(parameters.expected());
    write_fall(folder, test::record_of(with_tables, fall, expected));
    plan_falls(folder, {{{"name", "fall_00"}, {"mesh", "mesh"}}, {{"name", "fall_01"}, {"mesh", "mesh"}}});
    folder.write("fall_01/failed.json", R"({"reason": "the solver stopped"})");
    double share = 0.0;
    const Conversion conversion = convert_folder(folder.path(), {}, [&](double now) { share = now; });
    EXPECT_EQ(share, 1.0);
    ASSERT_TRUE(conversion.identification);
    ASSERT_EQ(conversion.identification->falls.size(), 1U);
    EXPECT_EQ(conversion.identification->falls[0].name, "fall_00");
    EXPECT_LT(conversion.identification->prediction_error, 0.02);
    ASSERT_TRUE(conversion.body.dynamic);
    const Matrix3d& transport = conversion.body.dynamic->values.transport;
    EXPECT_LT((transport - expected.transport).norm(), 0.05 * expected.transport.norm());
    EXPECT_EQ(conversion.left_out.size(), 1U);
}

}  // namespace
}  // namespace samara
