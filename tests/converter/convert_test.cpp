#include "converter/convert.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "converter/falls/motion_parameters.hpp"
#include "converter/openfoam/foam_history.hpp"
#include "converter/tables/direction_sampling.hpp"
#include "load_laws.hpp"
#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/surface/octahedral_map.hpp"
#include "solved_folder.hpp"
#include "support/expect_error.hpp"
#include "support/known_bodies.hpp"
#include "symmetry_groups.hpp"
#include "synthetic_fall.hpp"

namespace samara {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

LoadEntry box_law(const Vector3d& direction, double reynolds_number) {
    LoadEntry entry = test::BoxLaw{}(direction);
    entry.force *= 1.0 + 1000.0 / reynolds_number;
    return entry;
}

Body turned_box() {
    Body body = test::box_body(Vector3d(0.01, 0.02, 0.04));
    body.symmetry = test::turned(body.symmetry, test::some_rotation());
    for (Vector3d& vertex : body.surface.vertices) vertex = test::some_rotation() * vertex;
    return body;
}

class Convert : public testing::Test {
  protected:
    std::string error() const {
        return test::error_of([&] { convert_folder(folder_.path()); });
    }

    test::SolvedFolder folder_{test::box_body(Vector3d(0.01, 0.02, 0.04)), 2, {1e3, 1e4}, box_law};
};

TEST_F(Convert, FillsTheTablesInBodyAxesWhateverTheyAre) {
    const test::SolvedFolder folder(turned_box(), 2, {1e4, 1e3}, box_law);
    const Body body = convert_folder(folder.path()).body;
    ASSERT_TRUE(body.tables);
    const LoadTables& tables = *body.tables;
    EXPECT_EQ(tables.reynolds_numbers, (std::vector<double>{1e3, 1e4}));
    EXPECT_EQ(tables.entries.size(), 2U * 25U);
    EXPECT_EQ(tables.subdivisions, 2);
    EXPECT_EQ(tables.quality, "smoke");
    EXPECT_EQ(tables.reference_length, reference_length(body.moments.surface_area));
    for (const double reynolds_number : tables.reynolds_numbers) {
        for (const Vector3d& node : octahedral_nodes(2)) {
            const LoadEntry exact = transformed(box_law(node, reynolds_number), tables.axes);
            const LoadEntry found = look_up(tables, tables.axes * node, reynolds_number);
            EXPECT_LT(test::difference(found, exact), 1e-8);
        }
    }
}

TEST_F(Convert, GivesTheTailOfTheIterationsAsError) {
    const Conversion conversion = convert_folder(folder_.path());
    const auto& [direction, entry, error] = conversion.cases.front().sample;
    EXPECT_EQ(direction, Vector3d(1, 0, 0));
    // Of 11 iterations the last 9 make three batches, whose means are off by 1/3, -1/3 and 0 of 0.01 F; the
    // last 10 make two halves, whose means are off by -1/5 and 0 of it. Ten of the eleven are off by 0.01 F
    // themselves.
    const double relative = 0.01 * std::hypot(1.0 / std::sqrt(27.0), 0.1, std::sqrt(10.0 / 11.0));
    EXPECT_NEAR(error.force.x(), relative * std::abs(entry.force.x()), 1e-8);
    EXPECT_EQ(error.force.y(), 0.0);
    EXPECT_NEAR(error.turbulent_kinetic_energy, relative * entry.turbulent_kinetic_energy, 1e-10);
    EXPECT_NEAR(error.dissipation_rate, relative * entry.dissipation_rate, 1e-10);
    const LoadTables& tables = *conversion.body.tables;
    ASSERT_EQ(tables.error_sources.front().source, ErrorSource::tail);
    EXPECT_NEAR(tables.error_sources.front().turbulent_kinetic_energy,
                std::pow(1.0 + 0.5 * relative, 2.0) - 1.0, 1e-8);
    EXPECT_GT(tables.errors[tables.index(0, 2, 4)].force.x(), error.force.x());
}

TEST_F(Convert, TakesWhatSymmetryForbidsAsError) {
    const auto lopsided = [](const Vector3d& direction, double reynolds_number) {
        LoadEntry entry = box_law(direction, reynolds_number);
        if (direction.x() == 1.0) entry.force.y() += 0.08;
        return entry;
    };
    const test::SolvedFolder folder(test::box_body(Vector3d(0.01, 0.02, 0.04)), 2, {1e4}, lopsided);
    const Conversion conversion = convert_folder(folder.path());
    const DirectionSample& broadside = conversion.cases.front().sample;
    EXPECT_EQ(broadside.entry.force.y(), 0.0);
    EXPECT_GT(broadside.error.force.y(), 0.08 / std::sqrt(2.0));
    EXPECT_LT(broadside.error.force.y(), 1.01 * 0.08 / std::sqrt(2.0));
}

TEST_F(Convert, KeepsTheRestOfTheBodyAndTheProvenance) {
    const Body body = convert_folder(folder_.path()).body;
    EXPECT_EQ(body.name, "box");
    EXPECT_EQ(surface_hash(body.surface), surface_hash(folder_.body().surface));
    const nlohmann::json provenance = nlohmann::json::parse(body.tables->provenance);
    ASSERT_EQ(provenance.size(), 12U);
    EXPECT_EQ(provenance[0]["name"], "case_00");
    EXPECT_EQ(provenance[0]["closure"], "kEpsilon");
    EXPECT_EQ(provenance[0]["direction"], (nlohmann::json{1.0, 0.0, 0.0}));
    EXPECT_EQ(provenance[11]["reynolds_number"], 1e4);
}

TEST_F(Convert, SaysHowFarItIs) {
    std::size_t last = 0;
    convert_folder(folder_.path(), [&](std::size_t done, std::size_t total) {
        EXPECT_EQ(done, ++last);
        EXPECT_EQ(total, 12U);
    });
    EXPECT_EQ(last, 12U);
}

TEST_F(Convert, NamesTheFirstCaseThatIsNotSolved) {
    std::filesystem::remove(folder_.case_path(3) / "provenance.json");
    std::filesystem::remove(folder_.case_path(5) / "provenance.json");
    EXPECT_EQ(error(), folder_.path().string() +
                           ": the case case_03 is not solved (2 of 12 are not); run 'samara bake' again, "
                           "which continues where it stopped");
}

TEST_F(Convert, FillsADirectionThatCouldNotBeSolvedAndSaysSo) {
    std::filesystem::remove(folder_.case_path(2) / "provenance.json");
    folder_.write("case_02/failed.json", R"({"reason": "never settled"})");
    const Conversion conversion = convert_folder(folder_.path());
    EXPECT_EQ(conversion.cases.size(), 11U);
    const LoadTables& tables = *conversion.body.tables;
    ASSERT_EQ(conversion.left_out.size(), 1U);
    EXPECT_EQ(conversion.left_out[0].name, "case_02");
    EXPECT_EQ(conversion.left_out[0].reason, "never settled");
    const Vector3d lost = octahedral_node(2, 2, 3);
    EXPECT_LT(test::difference(look_up(tables, lost, 1e3), box_law(lost, 1e3)), 0.5);
}

void plan_falls(const test::SolvedFolder& folder, const nlohmann::json& falls) {
    folder.change_plan([&](nlohmann::json& plan) { plan["falls"] = falls; });
}

TEST_F(Convert, LeavesOutAFallThatFailedAndTheBodyWithoutCoefficients) {
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

TEST_F(Convert, LeavesOutAFallWhoseMeshFailed) {
    plan_falls(folder_, {{{"name", "fall_00"}, {"mesh", "mesh_medium"}}});
    folder_.write("mesh_medium/failed.json", R"({"reason": "too few cells"})");
    const Conversion conversion = convert_folder(folder_.path());
    ASSERT_EQ(conversion.left_out.size(), 1U);
    EXPECT_EQ(conversion.left_out[0].reason, "its mesh mesh_medium could not be made: too few cells");
}

TEST_F(Convert, RejectsAFallThatIsNeitherSolvedNorFailed) {
    plan_falls(folder_, {{{"name", "fall_00"}, {"mesh", "mesh"}}, {{"name", "fall_01"}, {"mesh", "mesh"}}});
    folder_.write("fall_00/failed.json", R"({"reason": "the solver stopped"})");
    EXPECT_EQ(
        error(),
        folder_.path().string() +
            ": the fall fall_01 is not solved; run 'samara bake' again, which continues where it stopped");
}

TEST_F(Convert, RejectsAFallWithTheNameOfACase) {
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
TEST(ConvertFalls, IdentifiesTheCoefficientsOfTheFallsThatAreSolved) {
    Body body = test::box_body(Vector3d(0.02, 0.04, 0.08));
    body.kirchhoff = test::rubber_ellipsoid().kirchhoff;
    const test::SolvedFolder folder(body, 2, {1e3, 1e4}, box_law);
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

TEST_F(Convert, RejectsWhereMoreThanOneDirectionInFiveCouldNotBeSolved) {
    for (const std::size_t index : {6U, 7U, 8U, 9U, 0U, 1U, 2U, 3U}) {
        std::filesystem::remove(folder_.case_path(index) / "provenance.json");
        folder_.write(folder_.names()[index] + "/failed.json", R"({"reason": "never settled"})");
    }
    EXPECT_EQ(error(),
              (folder_.path() / "plan.json").string() +
                  ": 4 of the 6 directions at Reynolds number 1000 could not be solved, more than one "
                  "in five; the first is case_00: never settled; run 'samara bake' again");
}

// The case of a sphere, which has one direction.
TEST(ConvertOneDirection, TheMainReynoldsNumberIsThePlansWhateverCouldNotBeSolved) {
    const test::SolvedFolder folder(test::box_body(Vector3d(0.01, 0.02, 0.04)), 1, {1e3, 1e4, 1e4}, box_law);
    folder.change_plan([](nlohmann::json& plan) {
        const nlohmann::json cases = plan["cases"];
        plan["cases"] = {cases[0], cases[3], cases[6]};
        plan["cases"][1]["purpose"] = "mesh";
        plan["covers"] = "scene";
    });
    EXPECT_EQ(convert_folder(folder.path()).body.tables->reynolds_numbers, (std::vector<double>{1e3, 1e4}));
    std::filesystem::remove(folder.case_path(6) / "provenance.json");
    folder.write("case_06/failed.json", R"({"reason": "never settled"})");
    EXPECT_THAT(test::error_of([&] { convert_folder(folder.path()); }),
                HasSubstr("plan.json: 1 of the 1 directions at Reynolds number 10000 could not be solved"));
}

TEST_F(Convert, NamesTheCaseThatDiverged) {
    const std::filesystem::path forces = "case_02/postProcessing/forces/0/force.dat";
    const std::string text = read_bytes(folder_.path() / forces);
    folder_.write(forces, text.substr(0, text.rfind("20\t(")) + "20\t(nan nan nan)\t(0 0 0)\t(0 0 0)\n");
    EXPECT_THAT(
        error(),
        HasSubstr("case_02: diverged: postProcessing/forces/0/force.dat holds nan at the time 20; remove"));
}

TEST_F(Convert, RejectsThrust) {
    std::string rows = "# Time total_x total_y total_z\n";
    for (int i = 1; i <= 20; ++i) rows += fmt::format("{} 1 0 0\n", i);
    folder_.write("case_00/postProcessing/forces/0/force.dat", rows);
    EXPECT_THAT(error(), HasSubstr("case_00: diverged: the drag coefficient is -2.546, not positive"));
}

TEST_F(Convert, RejectsFieldsAndHistoriesOfDifferentRuns) {
    std::string rows = "# Time weightedVolAverage(k) weightedVolAverage(epsilon)\n";
    for (int i = 1; i <= 20; ++i) rows += fmt::format("{} 1 1\n", i);
    folder_.write("case_01/postProcessing/nearWake/0/volFieldValue.dat", rows);
    EXPECT_THAT(error(), HasSubstr("case_01: the mean k over the near wake at the time 20 is"));
    EXPECT_THAT(error(), HasSubstr("they are from different runs"));
}

TEST_F(Convert, RejectsCasesOfAnotherDirectionOrReynoldsNumberThanPlanned) {
    folder_.replace("case_01/parameters", "reynoldsNumber 1000", "reynoldsNumber 2000");
    EXPECT_THAT(error(),
                HasSubstr("case_01: was solved for the Reynolds number 2000, but plan.json has 1000"));
    folder_.replace("case_00/parameters", "direction (1 ", "direction (-1 ");
    EXPECT_THAT(error(),
                HasSubstr("case_00: was solved for the direction (-1, 0, 0), but plan.json has (1, 0, 0)"));
}

TEST_F(Convert, RejectsCasesWhoseKIsOfDifferentMeans) {
    folder_.replace("case_01/postProcessing/nearWake/0/volFieldValue.dat", "weightedVolAverage(k)",
                    "volAverage(k)");
    folder_.replace("case_01/postProcessing/nearWake/0/volFieldValue.dat", "weightedVolAverage(epsilon)",
                    "volAverage(epsilon)");
    std::filesystem::rename(folder_.path() / "case_01/postProcessing/nearWake",
                            folder_.path() / "case_01/postProcessing/shell");
    folder_.replace("mesh/constant/polyMesh/cellZones", "1\n(\nnearWake",
                    "2\n(\nshell\n{\n    type cellZone;\ncellLabels "
                    "List<label> 2(1 4);\n}\nnearWake");
    // Of (1.5, 0.5) m in cells of volumes 1 and 3 the mean by volume is 0.75 m.
    std::string rows = "# Time volAverage(k) volAverage(epsilon)\n";
    const FoamHistory whole =
        read_history(folder_.path() / "case_01/postProcessing/shell/0/volFieldValue.dat");
    for (const std::vector<double>& row : whole.rows) {
        rows += fmt::format("{} {} {}\n", row[0], 0.75 * row[1], 0.75 * row[2]);
    }
    folder_.write("case_01/postProcessing/shell/0/volFieldValue.dat", rows);
    EXPECT_THAT(error(),
                HasSubstr("k and epsilon of case_00 are of the mean 'near wake', those of case_01 of "
                          "'shell': tables hold one of them"));
}

TEST_F(Convert, RejectsTooFewIterations) {
    folder_.replace("case_00/provenance.json", "\"averaging_start\": 10", "\"averaging_start\": 18");
    EXPECT_THAT(error(), HasSubstr("force.dat: has 3 iterations from 18 on, too few"));
}

TEST_F(Convert, RejectsMeshesAndFieldsThatDoNotBelongTogether) {
    folder_.replace("mesh/constant/polyMesh/cellZones", "3(1 2 4)", "3(1 2 5)");
    EXPECT_THAT(error(), HasSubstr("/V: has no value for cell 5 of the near wake"));
    folder_.replace("mesh/constant/polyMesh/cellZones", "3(1 2 5)", "0()");
    EXPECT_THAT(error(), HasSubstr("cellZones: the zone 'nearWake' has no cells"));
}

TEST_F(Convert, RejectsAPlanOfAnotherBody) {
    write_body_file(folder_.path() / "body.body.h5", test::box_body(Vector3d(0.01, 0.02, 0.05)));
    EXPECT_THAT(error(), HasSubstr("plan.json and body.body.h5 belong to different bodies"));
}

TEST_F(Convert, NamesADirectionThatThePlanForgot) {
    nlohmann::json plan = nlohmann::json::parse(read_bytes(folder_.path() / "plan.json"));
    plan["cases"].erase(6);
    plan["cases"].erase(0);
    folder_.write("plan.json", plan.dump());
    EXPECT_THAT(error(),
                HasSubstr("plan.json: Reynolds number 1000: no case in the direction (1, 0, 0), which"));
}

TEST_F(Convert, RejectsDamagedPlansInOneLine) {
    const std::string plan = read_bytes(folder_.path() / "plan.json");
    const auto error_of = [&](const std::string& text) {
        folder_.write("plan.json", text);
        std::string message = error();
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_THAT(message,
                    EndsWith("make the cases again with 'samara bake', or correct the plan if you wrote it"));
        return message;
    };
    const auto changed = [&](const std::string& entry, const nlohmann::json& value) {
        nlohmann::json content = nlohmann::json::parse(plan);
        content[nlohmann::json::json_pointer(entry)] = value;
        return content.dump();
    };
    EXPECT_THAT(error_of(plan.substr(0, 100)), HasSubstr("plan.json: is not valid JSON ("));
    EXPECT_THAT(error_of("{}"), HasSubstr("an entry is missing or of the wrong type"));
    EXPECT_THAT(error_of(changed("/quality", 3)), HasSubstr("an entry is missing or of the wrong type"));
    EXPECT_THAT(error_of(changed("/subdivisions", 0)), HasSubstr("'subdivisions' is not from 1 to 1024"));
    EXPECT_THAT(error_of(changed("/reference_length", -1)), HasSubstr("'reference_length' is not positive"));
    EXPECT_THAT(error_of(changed("/axes/0/0", 2)), HasSubstr("'axes' is not a rotation"));
    EXPECT_THAT(error_of(changed("/cases", nlohmann::json::array())), HasSubstr("'cases' is empty"));
    EXPECT_THAT(error_of(changed("/cases/1/name", "case_00")), HasSubstr("two cases are named case_00"));
    EXPECT_THAT(error_of(changed("/cases/1/direction", {1, 1, 0})),
                HasSubstr("case_01 is not a unit vector"));
    EXPECT_THAT(error_of(changed("/cases/1/reynolds_number", 0)), HasSubstr("case_01 is not positive"));
}

TEST_F(Convert, ReadsThroughNoLinkOutOfTheFolderAndWaitsForNoPipe) {
    const test::TemporaryFolder elsewhere;
    const std::filesystem::path force = folder_.case_path(0) / "postProcessing/forces/0/force.dat";
    std::filesystem::rename(force, elsewhere / "force.dat");
    std::filesystem::create_symlink(elsewhere / "force.dat", force);
    EXPECT_EQ(error(), force.string() + ": is a link to outside of " + folder_.path().string() +
                           ", which is not followed; replace it by a copy, or remove it");
    std::filesystem::remove(force);
    ASSERT_EQ(::mkfifo(force.c_str(), 0600), 0);
    EXPECT_EQ(error(), force.string() + ": is neither a file nor a folder; remove it");
    std::filesystem::remove(force);
    std::filesystem::rename(elsewhere / "force.dat", folder_.path() / "kept.dat");
    std::filesystem::create_symlink(folder_.path() / "kept.dat", force);
    EXPECT_NO_THROW(convert_folder(folder_.path()));
}

TEST_F(Convert, ReadsNoFolderBesideTheCases) {
    for (const char* name : {"../case_00", "/tmp", ""}) {
        for (const char* key : {"name", "mesh"}) {
            folder_.change_plan([&](nlohmann::json& plan) { plan["cases"][0][key] = name; });
            EXPECT_THAT(error(), HasSubstr("' is not the name of a folder beside plan.json"));
            folder_.change_plan([&](nlohmann::json& plan) { plan["cases"][0][key] = "case_00"; });
        }
    }
}

TEST_F(Convert, NamesAKeyOfThePlanThatItDoesNotKnow) {
    folder_.change_plan([](nlohmann::json& plan) { plan["cases"][0]["lenght"] = 2.0; });
    EXPECT_THAT(error(), HasSubstr("plan.json: a case has the unknown key 'lenght'; did you mean 'length'?"));
    folder_.change_plan([](nlohmann::json& plan) {
        plan["cases"][0].erase("lenght");
        plan["sub_divisions"] = 2;
    });
    EXPECT_THAT(
        error(),
        HasSubstr("plan.json: the plan has the unknown key 'sub_divisions'; did you mean 'subdivisions'?"));
}

/// A folder that the user solved, in units in which L is 2, the speed 3 and the density 5.
class ConvertOfAUsersCases : public Convert {
  protected:
    void SetUp() override {
        folder_.change_plan([](nlohmann::json& plan) {
            plan["solved_by"] = "user";
            plan["length"] = 2.0;
            plan["speed"] = 3.0;
            plan["density"] = 5.0;
        });
        set_up("uniform (-3 0 0)", "nu [0 2 -1 0 0 0 0] 6e-3", "rhoInf 5");
        // A cube around the origin whose area is that of a sphere of diameter 2.
        const double half = std::sqrt(4.0 * std::numbers::pi / 6.0) / 2.0;
        std::string points = header("vectorField") + "8\n(\n";
        for (int i = 0; i < 8; ++i) {
            points += fmt::format("({} {} {})\n", (i & 1) != 0 ? half : -half, (i & 2) != 0 ? half : -half,
                                  (i & 4) != 0 ? half : -half);
        }
        const std::string mesh = "mesh/constant/polyMesh/";
        folder_.write(mesh + "points", points + ")\n");
        folder_.write(mesh + "faces", header("faceList") +
                                          "6(4(0 2 3 1) 4(4 5 7 6) 4(0 1 5 4) 4(2 6 7 3) 4(0 4 6 2) "
                                          "4(1 3 7 5))\n");
        folder_.write(mesh + "owner", header("labelList") + "6(0 0 0 0 0 0)\n");
        folder_.write(mesh + "neighbour", header("labelList") + "0()\n");
        folder_.write(mesh + "boundary",
                      header("polyBoundaryMesh") + "1(cube { type wall; nFaces 6; startFace 0; })\n");
    }
    static std::string header(const std::string& kind) {
        return "FoamFile { version 2.0; format ascii; class " + kind + "; object x; }\n";
    }
    /// The flow that the first case sets up.
    void set_up(const std::string& flow, const std::string& viscosity, const std::string& density) {
        folder_.write("case_00/0/U", header("volVectorField") +
                                         "internalField uniform (0 0 0);\nboundaryField { far { type "
                                         "freestreamVelocity; freestreamValue " +
                                         flow + "; } cube { type noSlip; } }\n");
        folder_.write("case_00/constant/transportProperties",
                      header("dictionary") + "transportModel Newtonian;\n" + viscosity + ";\n");
        folder_.write("case_00/system/controlDict",
                      header("dictionary") +
                          "functions { forces { type forces; patches (cube); rho rhoInf; " + density +
                          "; } }\n");
    }
    std::string error_with(const char* key, const nlohmann::json& value) {
        nlohmann::json before;
        folder_.change_plan([&](nlohmann::json& plan) { before = std::exchange(plan[key], value); });
        std::string said = error();
        folder_.change_plan([&](nlohmann::json& plan) { plan[key] = before; });
        EXPECT_THAT(said, testing::StartsWith(folder_.case_path(0).string() + ": "));
        return said;
    }
};

TEST_F(ConvertOfAUsersCases, TakesThePlanThatIsOfThem) {
    EXPECT_NO_THROW(convert_folder(folder_.path()));
    folder_.write("case_00/numbers", "speed 3;\nflowVelocity (-3 0 0);\nviscosity 6e-3;\n");
    set_up("uniform $flowVelocity", "nu $viscosity", "rhoInf 5");
    for (const char* file : {"case_00/0/U", "case_00/constant/transportProperties"}) {
        folder_.write(file, read_bytes(folder_.path() / file) + "#include \"../numbers\"\n");
    }
    EXPECT_NO_THROW(convert_folder(folder_.path()));
    EXPECT_THAT(error_with("speed", 5.0),
                HasSubstr("the speed of the flow far from the body is 3, but plan.json has the "
                          "'speed' 5; correct the plan, or solve the case for it"));
}

TEST_F(ConvertOfAUsersCases, RejectsAPlanWhoseNumbersAreNotTheirs) {
    EXPECT_THAT(error_with("length", 13.8),
                HasSubstr("sqrt(S/pi) of the body's area S in the mesh is 2, but plan.json has "
                          "the 'length' 13.8"));
    EXPECT_THAT(error_with("speed", 5.0), HasSubstr("is 3, but plan.json has the 'speed' 5"));
    EXPECT_THAT(error_with("density", 1.0),
                HasSubstr("(rhoInf of the function object forces) is 5, but plan.json has the "
                          "'density' 1"));
    set_up("uniform (-3 0 0)", "nu 0.01", "rhoInf 5");
    EXPECT_THAT(
        error(),
        HasSubstr("with its viscosity of 0.01, the length 2 and the speed 3 the Reynolds number is 600, but "
                  "plan.json has the 'reynolds_number' 1000"));
}

TEST_F(ConvertOfAUsersCases, SaysWhichDirectionTheirFlowHas) {
    set_up("uniform (3 0 0)", "nu 6e-3", "rhoInf 5");
    EXPECT_THAT(
        error(),
        HasSubstr("case_00: the flow has the opposite direction: along [1, 0, 0], so the body moves along "
                  "[-1, 0, 0], but plan.json has the 'direction' [1, 0, 0] of the body's velocity"));
    set_up("uniform (0 -3 0)", "nu 6e-3", "rhoInf 5");
    EXPECT_THAT(error(),
                HasSubstr("the flow has the direction [0, -1, 0], so the body moves along [0, 1, 0], but"));
}

TEST_F(ConvertOfAUsersCases, HoldsNothingAgainstWhatTheyDoNotSayPlainly) {
    set_up("uniform $unknown", "nu #calc \"1\"", "rhoInf $unknown");
    EXPECT_NO_THROW(convert_folder(folder_.path()));
    for (const char* file :
         {"case_00/0/U", "case_00/constant/transportProperties", "case_00/system/controlDict"}) {
        folder_.write(file, "neither { this\nnor");
    }
    EXPECT_NO_THROW(convert_folder(folder_.path()));
}

// The cases are of the octant opposite to that of the table.
TEST(ConvertBySymmetry, BringsADirectionToTheOneThatTheTableHas) {
    Body body = test::box_body(Vector3d(0.01, 0.02, 0.04));
    const Symmetry symmetry = body.symmetry;
    body.symmetry = {};
    const test::SolvedFolder folder(body, 2, {1e4}, box_law);
    body.symmetry = symmetry;
    write_body_file(folder.path() / "body.body.h5", body);
    folder.change_plan([](nlohmann::json& plan) {
        nlohmann::json kept = nlohmann::json::array();
        for (const nlohmann::json& one : plan["cases"]) {
            if (std::ranges::all_of(one["direction"],
                                    [](const nlohmann::json& x) { return x.get<double>() <= 0.0; })) {
                kept.push_back(one);
            }
        }
        plan["cases"] = kept;
    });
    const LoadTables tables = *convert_folder(folder.path()).body.tables;
    for (const Vector3d& node : octahedral_nodes(2)) {
        EXPECT_LT(test::difference(look_up(tables, node, 1e4), box_law(node, 1e4)), 1e-8);
    }
}

/// Runs samara-convert; returns its exit status and output.
class ConvertProgram : public Convert {
  protected:
    std::pair<int, std::string> run(std::vector<std::string> words) const {
        words.insert(words.begin(), std::string(SAMARA_PROGRAMS) + "/samara-convert");
        const std::filesystem::path output = scratch_.path() / "output";
        const int status = run_subprocess(words, output);
        return {status, read_bytes(output)};
    }

    test::TemporaryFolder scratch_;
};

TEST_F(ConvertProgram, WritesTheBodyFileAndOneJsonObject) {
    const std::string file = scratch_.path() / "b.body.h5";
    const auto [status, text] = run({folder_.path().string(), "-o", file, "--json"});
    ASSERT_EQ(status, 0) << text;
    const nlohmann::json result = nlohmann::json::parse(text);
    EXPECT_EQ(result["cases"].size(), 12U);
    EXPECT_EQ(result["nodes"], 50);
    EXPECT_NEAR(result["cases"][0]["drag_coefficient"].get<double>(), 2.0 * 0.6, 1e-9);
    EXPECT_EQ(result["reynolds_numbers"], (nlohmann::json{1e3, 1e4}));
    const Body body = read_body_file(file);
    ASSERT_TRUE(body.tables);
    EXPECT_NEAR(look_up(*body.tables, Vector3d::UnitZ(), 1e4).force.z(), -1.1 * 1.9, 1e-9);
}

TEST_F(ConvertProgram, EqualCasesGiveEqualTablesToTheLastBit) {
    const std::string file = scratch_.path() / "a.body.h5";
    ASSERT_EQ(run({folder_.path().string(), "-o", file}).first, 0);
    const LoadTables written = read_body_file(file).tables.value();
    const LoadTables again = convert_folder(folder_.path()).body.tables.value();
    ASSERT_EQ(written.entries.size(), again.entries.size());
    for (std::size_t i = 0; i < again.entries.size(); ++i) {
        EXPECT_EQ(test::difference(written.entries[i], again.entries[i]), 0.0);
        EXPECT_EQ(test::difference(written.errors[i], again.errors[i]), 0.0);
    }
    EXPECT_EQ(written.provenance, again.provenance);
}

TEST_F(ConvertProgram, PrintsATableWithErrors) {
    const auto [status, text] = run({folder_.path().string(), "-o", scratch_.path() / "b.body.h5"});
    ASSERT_EQ(status, 0) << text;
    EXPECT_THAT(text, HasSubstr("12 solved cases -> 50 table nodes"));
    EXPECT_THAT(text, HasSubstr("(1.0000, 0.0000, 0.0000)"));
    EXPECT_THAT(text, HasSubstr("1.200 +- 0.012"));
}

TEST_F(ConvertProgram, AnswersForeignFoldersWithOneLine) {
    const std::string output = scratch_.path() / "b.body.h5";
    for (const std::string& folder : {scratch_.path().string(), std::string("/no/such/folder")}) {
        const auto [status, text] = run({folder, "-o", output});
        EXPECT_EQ(status, 1);
        EXPECT_THAT(text, testing::StartsWith("samara convert: " + folder + ": is not a folder"));
        EXPECT_THAT(text, EndsWith("give the folder NAME.cases that 'samara bake' made\n"));
    }
    EXPECT_FALSE(std::filesystem::exists(output));
    const auto [status, text] = run({folder_.path().string(), "-o", "b.h5"});
    EXPECT_EQ(status, 1);
    EXPECT_THAT(text, HasSubstr("name it NAME.body.h5"));
}

}  // namespace
}  // namespace samara
