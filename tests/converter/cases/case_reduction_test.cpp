#include "converter/cases/case_reduction.hpp"

#include <algorithm>
#include <numbers>
#include <regex>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "converter/cases/samples_csv.hpp"
#include "converter/openfoam/foam_file.hpp"
#include "converter/openfoam/foam_history.hpp"
#include "gzip.hpp"
#include "load_laws.hpp"
#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/files/content_hash.hpp"
#include "solved_folder.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "symmetry_groups.hpp"

namespace samara {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// Six solved cases of a box, in nondimensional units.
class CaseReduction : public testing::Test {
  protected:
    std::vector<SolvedCase> reduced() const {
        return reduce_folder(folder_.path(), read_case_plan(folder_.path())).cases;
    }
    std::string error() const {
        std::string message = test::error_of([&] { reduced(); });
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        return message;
    }
    void move(const std::string& from, const std::string& to) const {
        std::filesystem::create_directories((folder_.path() / to).parent_path());
        std::filesystem::rename(folder_.path() / from, folder_.path() / to);
    }

    test::SolvedFolder folder_{test::box_body(Vector3d(0.01, 0.02, 0.04)), 2, {1e4}, test::box_law};
};

TEST_F(CaseReduction, TakesWhatThePlanSaysOfACase) {
    folder_.change_plan([](json& plan) {
        plan["cases"][1]["purpose"] = "mesh";
        plan["cases"][1]["mesh"] = "mesh_coarse";
        plan["cases"][2]["purpose"] = "closure";
        plan["cases"][2]["closure"] = "realizableKE";
    });
    move("mesh", "mesh_coarse");
    folder_.write("mesh/constant/polyMesh/cellZones",
                  read_bytes(folder_.path() / "mesh_coarse/constant/polyMesh/cellZones"));
    folder_.replace("case_02/provenance.json", "\"closure\": \"kEpsilon\", ", "");
    const std::vector<SolvedCase> cases = reduced();
    ASSERT_EQ(cases.size(), 6U);
    EXPECT_EQ(cases[0].purpose, CasePurpose::table);
    EXPECT_EQ(cases[0].mesh, "mesh");
    EXPECT_EQ(cases[0].closure, Closure::k_epsilon);  // of provenance.json
    EXPECT_EQ(cases[1].purpose, CasePurpose::mesh);
    EXPECT_EQ(cases[1].mesh, "mesh_coarse");
    EXPECT_EQ(cases[2].purpose, CasePurpose::closure);
    EXPECT_EQ(cases[2].closure, Closure::realizable_k_epsilon);  // of plan.json
}

TEST_F(CaseReduction, ReadsTheShellOfTheMeshThatACaseNames) {
    folder_.change_plan([](json& plan) {
        plan["cases"][1]["purpose"] = "mesh";
        plan["cases"][1]["mesh"] = "mesh_coarse";
    });
    std::string zones = read_bytes(folder_.path() / "mesh/constant/polyMesh/cellZones");
    folder_.write("mesh_coarse/constant/polyMesh/cellZones", zones.replace(zones.find("1 2 4"), 5, "0 2 4"));
    EXPECT_THAT(error(), HasSubstr("case_01: the mean k over the near wake at the time 20 is"));
    std::filesystem::remove_all(folder_.path() / "mesh");
    std::filesystem::remove_all(folder_.path() / "mesh_coarse");
    EXPECT_THAT(error(), HasSubstr("case_00/constant/polyMesh/cellZones: does not exist; check the name"));
}

TEST_F(CaseReduction, LeavesOutWhatFailed) {
    move("case_02/provenance.json", "case_02/failed.json");
    folder_.write("case_02/failed.json", R"({"reason": "diverged after 3 retries"})");
    const FolderReduction reduction = reduce_folder(folder_.path(), read_case_plan(folder_.path()));
    EXPECT_EQ(reduction.cases.size(), 5U);
    ASSERT_EQ(reduction.left_out.size(), 1U);
    EXPECT_EQ(reduction.left_out[0].name, "case_02");
    EXPECT_EQ(reduction.left_out[0].reason, "diverged after 3 retries");
    folder_.write("case_02/failed.json", "{}");
    EXPECT_THAT(error(), HasSubstr("case_02/failed.json: has no text 'reason'"));
}

TEST_F(CaseReduction, LeavesOutTheCasesOfAMeshThatFailed) {
    folder_.change_plan([](json& plan) {
        plan["cases"][1]["purpose"] = "mesh";
        plan["cases"][1]["mesh"] = "mesh_coarse";
    });
    std::filesystem::remove(folder_.case_path(1) / "provenance.json");
    folder_.write("mesh_coarse/failed.json", R"({"reason": "has no layers"})");
    const FolderReduction reduction = reduce_folder(folder_.path(), read_case_plan(folder_.path()));
    EXPECT_EQ(reduction.cases.size(), 5U);
    ASSERT_EQ(reduction.left_out.size(), 1U);
    EXPECT_EQ(reduction.left_out[0].reason, "its mesh mesh_coarse could not be made: has no layers");
}

/// Lets case_00 take its k and epsilon from case_01, which becomes of the same flow.
void take_turbulence_from_second(json& plan) {
    plan["cases"][1] = plan["cases"][0];
    plan["cases"][1]["name"] = "case_01";
    plan["cases"][1]["purpose"] = "turbulence";
    plan["cases"][0]["turbulence_from"] = "case_01";
}

TEST_F(CaseReduction, TakesTheTurbulenceOfAnotherCaseOfTheSameFlow) {
    const SolvedCase own = reduced().front();
    std::filesystem::remove_all(folder_.case_path(1));
    std::filesystem::copy(folder_.case_path(0), folder_.case_path(1),
                          std::filesystem::copy_options::recursive);
    folder_.change_plan(take_turbulence_from_second);
    std::filesystem::remove_all(folder_.path() / "case_00/postProcessing/nearWake");
    folder_.replace("case_00/provenance.json", "kEpsilon", "kOmegaSST");
    const std::vector<SolvedCase> cases = reduced();
    ASSERT_EQ(cases.size(), 5U);
    EXPECT_EQ(cases[0].closure, Closure::k_omega_sst);
    EXPECT_EQ(cases[0].sample.entry.force, own.sample.entry.force);
    EXPECT_EQ(cases[0].sample.entry.dissipation_rate, own.sample.entry.dissipation_rate);
    EXPECT_EQ(cases[0].sample.entry.turbulent_kinetic_energy, own.sample.entry.turbulent_kinetic_energy);
    EXPECT_EQ(json::parse(cases[0].provenance)["turbulence"]["closure"], "kEpsilon");
}

TEST_F(CaseReduction, LeavesOutTheCaseWhoseTurbulenceFailed) {
    folder_.change_plan(take_turbulence_from_second);
    move("case_01/provenance.json", "case_01/failed.json");
    folder_.write("case_01/failed.json", R"({"reason": "diverged"})");
    const FolderReduction reduction = reduce_folder(folder_.path(), read_case_plan(folder_.path()));
    EXPECT_EQ(reduction.cases.size(), 4U);
    ASSERT_EQ(reduction.left_out.size(), 1U);
    EXPECT_EQ(reduction.left_out[0].name, "case_00");
    EXPECT_EQ(reduction.left_out[0].reason, "its turbulence's case case_01: diverged");
}

TEST_F(CaseReduction, RejectsTurbulenceOfAnotherFlowOrPurpose) {
    folder_.change_plan([](json& plan) { plan["cases"][0]["turbulence_from"] = "case_07"; });
    EXPECT_THAT(error(),
                HasSubstr("the case case_00 takes its turbulence from case_07, which is not a case"));
    folder_.change_plan([](json& plan) {
        plan["cases"][1]["purpose"] = "turbulence";
        plan["cases"][0]["turbulence_from"] = "case_01";
    });
    EXPECT_THAT(error(), HasSubstr("takes its turbulence from case_01, which is not a case"));
}

TEST_F(CaseReduction, RejectsWhatIsNotSolvedUnlessAskedToLeaveItOut) {
    std::filesystem::remove(folder_.case_path(4) / "provenance.json");
    EXPECT_THAT(error(), HasSubstr("the case case_04 is not solved (1 of 6 are not)"));
    const FolderReduction reduction =
        reduce_folder(folder_.path(), read_case_plan(folder_.path()), {}, UnsolvedCases::leave_out);
    EXPECT_EQ(reduction.cases.size(), 5U);
    EXPECT_EQ(reduction.left_out.at(0).reason, "is not solved yet");
}

TEST_F(CaseReduction, AveragesTheLastQuarterByDefault) {
    folder_.write("case_00/provenance.json", R"({"closure": "kEpsilon"})");
    const SolvedCase solved = reduced().front();
    // Of 20 iterations the last 5: off their mean by 0.01, -0.01, 0.01, -0.01 and 0.
    EXPECT_NEAR(solved.sample.entry.force.x(), -0.6, 1e-9);
    EXPECT_EQ(solved.provenance, R"({"closure":"kEpsilon"})");
    // Batches of two have equal means, the two halves (of the last four) as well.
    EXPECT_LT(solved.sample.error.force.x(), 0.6 * 0.01);
    folder_.change_plan([](json& plan) { plan["cases"][0]["averaging_start"] = 18.0; });
    EXPECT_THAT(error(), HasSubstr("force.dat: has 3 iterations from 18 on, too few"));
    folder_.change_plan([](json& plan) { plan["cases"][0]["averaging_start"] = 1.0; });
    // All iterations, also the transient of the first nine: 1 + (1 + 1/2 + ... + 1/9)/20.
    EXPECT_NEAR(reduced().front().sample.entry.force.x(), -0.6 * (1.0 + 2.8289682539682537 / 20.0), 1e-9);
    folder_.write("case_01/provenance.json", R"({"averaging_start": "late"})");
    EXPECT_THAT(error(), HasSubstr("case_01: 'averaging_start' in provenance.json is not a number"));
}

TEST_F(CaseReduction, JoinsTheHistoriesOfRounds) {
    const LoadEntry whole = reduced().front().sample.entry;
    for (const char* const name :
         {"forces/0/force.dat", "forces/0/moment.dat", "nearWake/0/volFieldValue.dat"}) {
        const std::string file = std::string("case_00/postProcessing/") + name;
        const std::string text = read_bytes(folder_.path() / file);
        const std::size_t heading = text.find("\n1\t") + 1;
        // The first round was killed within a line of iteration 17; the second started from iteration 14.
        const std::size_t line = text.find("\n15\t") + 1;
        std::string later = file;
        later.replace(later.find("/0/"), 3, "/14/");
        folder_.write(later, text.substr(0, heading) + text.substr(line));
        const bool is_scalar = file.ends_with("volFieldValue.dat");
        const std::string first = text.substr(0, text.find("\n16\t") + 1) +
                                  (is_scalar ? "16\t9 9\n17\t9" : "16\t(9 9 9)\t(0 0 0)\t(0 0 0)\n17\t(9");
        folder_.write(file, first);
    }
    EXPECT_EQ(test::difference(reduced().front().sample.entry, whole), 0.0);
}

TEST_F(CaseReduction, ReadsTheForcesOfTheFoundation) {
    const LoadEntry whole = reduced().at(1).sample.entry;
    const std::filesystem::path forces = folder_.case_path(1) / "postProcessing/forces";
    const FoamHistory force = read_joined_history(forces, "force");
    const FoamHistory moment = read_joined_history(forces, "moment");
    std::string text =
        "# Forces\n# CofR : (0 0 0)\n# Time forces(pressure viscous porous) moments(pressure viscous "
        "porous)\n";
    for (std::size_t i = 0; i < force.rows.size(); ++i) {
        const std::vector<double>& f = force.rows[i];
        const std::vector<double>& m = moment.rows[i];
        text += fmt::format("{} (({} {} {}) (1 2 3) (-1 -2 -3)) (({} {} {}) (-1 0 0) (1 0 0))\n", f[0], f[1],
                            f[2], f[3], m[1], m[2], m[3]);
    }
    std::filesystem::remove_all(forces / "0");
    folder_.write("case_01/postProcessing/forces/0/forces.dat", text);
    EXPECT_LT(test::difference(reduced().at(1).sample.entry, whole), 1e-12);
    std::filesystem::remove_all(forces / "0");
    EXPECT_THAT(error(),
                HasSubstr("case_01/postProcessing/forces: has no force.dat in any folder of a start time"));
}

TEST_F(CaseReduction, OfLaminarCasesHasNoTurbulence) {
    std::filesystem::remove_all(folder_.case_path(3) / "postProcessing/nearWake");
    std::filesystem::remove_all(folder_.case_path(3) / "20");
    EXPECT_THAT(error(), HasSubstr("case_03/postProcessing/nearWake: has no volFieldValue.dat"));
    folder_.replace("case_03/provenance.json", "kEpsilon", "laminar");
    const DirectionSample sample = reduced().at(3).sample;
    EXPECT_EQ(sample.entry.turbulent_kinetic_energy, 0.0);
    EXPECT_EQ(sample.entry.dissipation_rate, 0.0);
    EXPECT_EQ(sample.error.turbulent_kinetic_energy, 0.0);
    EXPECT_LT(sample.entry.force.dot(sample.direction), 0.0);
}

TEST_F(CaseReduction, RejectsTurbulenceThatIsNotPositive) {
    for (const char* const name : {"20/k", "20/epsilon"}) {
        const std::string file = std::string("case_03/") + name;
        const std::string text = read_bytes(folder_.path() / file);
        folder_.write(file, text.substr(0, text.find("internalField")) + "internalField uniform -1;\n");
    }
    std::string rows = "# Time weightedVolAverage(k) weightedVolAverage(epsilon)\n";
    for (int i = 1; i <= 20; ++i) rows += fmt::format("{} -1 -1\n", i);
    folder_.write("case_03/postProcessing/nearWake/0/volFieldValue.dat", rows);
    EXPECT_THAT(error(), HasSubstr("case_03/postProcessing/nearWake/0/volFieldValue.dat: the k is -1 at the "
                                   "time 10, but cannot be negative"));
    folder_.write("case_03/postProcessing/nearWake/0/volFieldValue.dat",
                  std::regex_replace(rows, std::regex("-1"), "1"));
    EXPECT_THAT(error(), HasSubstr("case_03/20/k: is -1 in cell 1, which is impossible"));
}

TEST_F(CaseReduction, HoldsTheFieldsAgainstTheHistoryAtTheirOwnTime) {
    move("case_00/20", "case_00/19");
    EXPECT_THAT(error(),
                HasSubstr("case_00: the mean k over the near wake at the time 19 is 0.014 in the fields "
                          "and 0.01386 in postProcessing: they are from different runs"));
    move("case_00/19", "case_00/25");
    EXPECT_THAT(error(), HasSubstr("case_00: the fields were last written at the time 25, which is missing "
                                   "in the history of k"));
    move("case_00/25", "elsewhere");
    EXPECT_THAT(error(), HasSubstr("case_00: has no written iteration"));
}

/// Rewrites a case as earlier versions left it: with means by volume over the zone `shell`.
TEST_F(CaseReduction, TakesTheShellsMeansOfEarlierCases) {
    const double k = reduced().front().sample.entry.turbulent_kinetic_energy;
    EXPECT_EQ(reduced().front().turbulence_mean, TurbulenceMean::near_wake);
    for (const char* name : {"case_00", "case_01", "case_02", "case_03", "case_04", "case_05"}) {
        const std::string folder = std::string(name) + "/postProcessing/";
        const std::string text = read_bytes(folder_.path() / (folder + "nearWake/0/volFieldValue.dat"));
        folder_.write(folder + "shell/0/volFieldValue.dat",
                      std::regex_replace(text, std::regex("weightedVolAverage"), "volAverage"));
        std::filesystem::remove_all(folder_.path() / (folder + "nearWake"));
        for (const char* field : {"k", "epsilon"}) {
            // Of (1.5, 0, 0.5) m in cells of volumes 1, 2 and 3 the mean by volume is m/2.
            const std::string file = std::string(name) + "/20/" + field;
            std::string twice =
                "FoamFile { version 2.0; format ascii; class volScalarField; object any; }\n"
                "internalField nonuniform List<scalar> 5(";
            for (const double value : read_scalar_field(folder_.path() / file).values) {
                twice += fmt::format("{} ", 2.0 * value);
            }
            folder_.write(file, twice + ");\n");
        }
    }
    folder_.replace("mesh/constant/polyMesh/cellZones", "nearWake", "shell");
    EXPECT_EQ(reduced().front().turbulence_mean, TurbulenceMean::shell);
    EXPECT_DOUBLE_EQ(reduced().front().sample.entry.turbulent_kinetic_energy, k);
}

TEST_F(CaseReduction, NamesBrokenFilesInOneLine) {
    const std::filesystem::path k = folder_.case_path(0) / "20/k";
    const std::string text = read_bytes(k);
    folder_.write("case_00/20/k.gz", test::gzipped(text));
    std::filesystem::remove(k);
    EXPECT_EQ(reduced().size(), 6U);
    folder_.write("case_00/20/k.gz", test::gzipped(text).substr(0, 60));
    EXPECT_THAT(error(), HasSubstr("case_00/20/k.gz: the compressed file is truncated; copy the file again"));
    std::filesystem::remove(folder_.case_path(0) / "20/k.gz");
    EXPECT_THAT(error(), HasSubstr("case_00/20/k: does not exist"));
    folder_.write("case_00/20/k", text);
    folder_.replace("case_00/20/k", "volScalarField", "volVectorField");
    EXPECT_THAT(error(), HasSubstr("case_00/20/k:7: holds a volVectorField, not a volScalarField"));
    folder_.write("case_00/20/k", text);
    folder_.replace("mesh/constant/polyMesh/cellZones", "nearWake", "wake");
    EXPECT_THAT(error(), HasSubstr("cellZones:15: has no cell zone 'nearWake' (it has: wake)"));
}

TEST_F(CaseReduction, RejectsTheSameCaseTwice) {
    folder_.change_plan([](json& plan) {
        json twin = plan["cases"][2];
        twin["name"] = "twin";
        plan["cases"].push_back(twin);
    });
    EXPECT_THAT(
        error(),
        HasSubstr(
            "plan.json: the cases case_02 and twin have the same direction, Reynolds number and purpose"));
    folder_.change_plan([](json& plan) { plan["cases"].back()["purpose"] = "twin"; });
    EXPECT_THAT(error(),
                HasSubstr("plan.json: 'purpose' is \"twin\", not table, mesh, closure, turbulence or start"));
    folder_.change_plan([](json& plan) {
        plan["cases"].erase(plan["cases"].size() - 1);
        plan["solved_by"] = "nobody";
    });
    EXPECT_THAT(error(), HasSubstr("plan.json: 'solved_by' is \"nobody\", not samara or user"));
}

/// The cases of CaseReduction as a user would have solved them: in SI units and in axes of his own, without
/// any of the files that `samara bake` leaves, each with its mesh.
class UsersCases : public CaseReduction {
  protected:
    UsersCases() {
        const std::vector<SolvedCase> nondimensional = reduced();
        for (const SolvedCase& solved : nondimensional) expected_.push_back(solved.sample);
        for (const std::string& name : folder_.names()) make_users(name);
        std::filesystem::remove_all(folder_.path() / "mesh");
        folder_.change_plan([&](json& plan) {
            json cases = json::array();
            for (const json& entry : plan["cases"]) {
                const Vector3d direction =
                    turn_ * Vector3d(entry["direction"][0], entry["direction"][1], entry["direction"][2]);
                cases.push_back({{"name", entry["name"]},
                                 {"direction", {direction.x(), direction.y(), direction.z()}},
                                 {"reynolds_number", 1e4},
                                 {"averaging_start", 10}});
            }
            json rows = json::array();
            const Matrix3d axes = folder_.body().symmetry.axes * turn_.transpose();
            for (int row = 0; row < 3; ++row) rows.push_back({axes(row, 0), axes(row, 1), axes(row, 2)});
            plan = {{"solved_by", "user"}, {"subdivisions", 2},   {"case_axes", rows}, {"length", length_},
                    {"speed", speed_},     {"density", density_}, {"cases", cases}};
        });
    }

    static constexpr double length_ = 0.03;
    static constexpr double speed_ = 2.5;
    static constexpr double density_ = 998.2;
    const Matrix3d turn_ = test::some_rotation();  ///< from the map's axes to those of the cases
    std::vector<DirectionSample> expected_;

  private:
    /// Rewrites a history with every vector rotated and scaled.
    void scale_vectors(const std::string& file, double scale) const {
        const FoamHistory history = read_history(folder_.path() / file);
        std::string text = "# Time total_x total_y total_z\n";
        for (const std::vector<double>& row : history.rows) {
            const Vector3d value = scale * (turn_ * Vector3d(row[1], row[2], row[3]));
            text += fmt::format("{} {} {} {}\n", row[0], value.x(), value.y(), value.z());
        }
        folder_.write(file, text);
    }
    void scale_field(const std::string& file, double scale) const {
        const FoamField<double> field = read_scalar_field(folder_.path() / file);
        std::string text =
            "FoamFile { version 2.0; format ascii; class volScalarField; object any; }\n"
            "internalField nonuniform List<scalar> 5(";
        for (const double value : field.values) text += fmt::format("{} ", scale * value);
        folder_.write(file, text + ");\n");
    }
    void make_users(const std::string& name) const {
        const double force = density_ * speed_ * speed_ * length_ * length_;
        const double k = speed_ * speed_;
        const double epsilon = speed_ * speed_ * speed_ / length_;
        scale_vectors(name + "/postProcessing/forces/0/force.dat", force);
        scale_vectors(name + "/postProcessing/forces/0/moment.dat", force * length_);
        const std::string means = name + "/postProcessing/nearWake/0/volFieldValue.dat";
        std::string text = "# Time weightedVolAverage(k) weightedVolAverage(epsilon)\n";
        for (const std::vector<double>& row : read_history(folder_.path() / means).rows) {
            text += fmt::format("{} {} {}\n", row[0], k * row[1], epsilon * row[2]);
        }
        folder_.write(means, text);
        scale_field(name + "/20/k", k);
        scale_field(name + "/20/epsilon", epsilon);
        scale_field(name + "/20/V", length_ * length_ * length_);
        folder_.write(name + "/constant/polyMesh/cellZones",
                      read_bytes(folder_.path() / "mesh/constant/polyMesh/cellZones"));
        std::filesystem::remove(folder_.path() / name / "provenance.json");
        std::filesystem::remove(folder_.path() / name / "parameters");
    }
};

TEST_F(UsersCases, AreThoseOfThePlanWithoutUnits) {
    const std::vector<SolvedCase> cases = reduced();
    ASSERT_EQ(cases.size(), expected_.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
        EXPECT_LT((cases[i].sample.direction - expected_[i].direction).norm(), 1e-12);
        EXPECT_LT(test::difference(cases[i].sample.entry, expected_[i].entry), 1e-12);
        EXPECT_LT(test::difference(cases[i].sample.error, expected_[i].error), 1e-12);
        EXPECT_EQ(cases[i].provenance, R"({"solved_by":"user"})");
    }
    const CasePlan plan = read_case_plan(folder_.path());
    EXPECT_EQ(plan.quality, "user");
    EXPECT_EQ(plan.reference_length, reference_length(folder_.body().moments.surface_area));
    EXPECT_EQ(plan.axes, folder_.body().symmetry.axes);
}

TEST_F(UsersCases, MayEachHaveUnitsOfTheirOwn) {
    folder_.change_plan([](json& plan) {
        plan.erase("speed");
        for (json& entry : plan["cases"]) entry["speed"] = speed_;
        plan["cases"][0]["speed"] = 2.0 * speed_;
    });
    const LoadEntry slow = reduced().front().sample.entry;
    EXPECT_NEAR(slow.force.x(), expected_.front().entry.force.x() / 4.0, 1e-12);
    EXPECT_NEAR(slow.turbulent_kinetic_energy, expected_.front().entry.turbulent_kinetic_energy / 4.0, 1e-12);
    EXPECT_NEAR(slow.dissipation_rate, expected_.front().entry.dissipation_rate / 8.0, 1e-12);
    folder_.change_plan([](json& plan) { plan["cases"][0]["speed"] = 0; });
    EXPECT_THAT(error(), HasSubstr("plan.json: the speed of case case_00 is not positive"));
}

TEST_F(UsersCases, ThatAreBrokenAreForTheUserToMend) {
    std::filesystem::remove_all(folder_.case_path(2));
    EXPECT_THAT(
        error(),
        HasSubstr("case_02: the case's folder is missing; solve it again, or remove it from plan.json"));
    std::filesystem::remove(folder_.path() / "body.body.h5");
    EXPECT_THAT(error(), HasSubstr("body.body.h5: "));
}

TEST_F(CaseReduction, CsvHasOneRowForEverySolvedCaseInBodyAxes) {
    std::vector<SolvedCase> cases = reduced();
    cases[1].name = "a \"good\", one";
    const std::string text =
        samples_csv(cases, Matrix3d(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitZ())));
    std::istringstream stream(text);
    std::string line;
    std::getline(stream, line);
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 23);
    std::getline(stream, line);
    EXPECT_THAT(line, testing::StartsWith("case_00,table,mesh,kEpsilon,"));
    std::vector<double> numbers;
    std::istringstream words(line.substr(std::string("case_00,table,mesh,kEpsilon,").size()));
    for (std::string word; std::getline(words, word, ',');) numbers.push_back(std::stod(word));
    ASSERT_EQ(numbers.size(), 20U);
    // The case's x axis is the body's y axis.
    EXPECT_NEAR(numbers[1], 1.0, 1e-15);
    EXPECT_EQ(numbers[3], 1e4);
    EXPECT_NEAR(numbers[5], cases[0].sample.entry.force.x(), 1e-15);
    EXPECT_EQ(numbers[10], cases[0].sample.entry.turbulent_kinetic_energy);
    EXPECT_NEAR(numbers[13], cases[0].sample.error.force.x(), 1e-15);
    EXPECT_EQ(numbers[19], cases[0].sample.error.dissipation_rate);
    std::getline(stream, line);
    EXPECT_THAT(line, testing::StartsWith("\"a \"\"good\"\", one\",table,"));
}

TEST_F(CaseReduction, TheProgramWritesTheCsv) {
    std::filesystem::remove(folder_.case_path(4) / "provenance.json");
    const test::TemporaryFolder scratch;
    const std::string program = std::string(SAMARA_PROGRAMS) + "/samara-convert";
    const std::string output = scratch.path() / "samples.csv";
    ASSERT_EQ(run_subprocess({program, folder_.path(), "-o", output, "--json"}, scratch.path() / "out"), 0);
    const json result = json::parse(read_bytes(scratch.path() / "out"));
    EXPECT_EQ(result["cases"], 5);
    EXPECT_EQ(result["left_out"], json::parse(R"([{"name": "case_04", "reason": "is not solved yet"}])"));
    const std::string text = read_bytes(output);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 6);
    ASSERT_EQ(run_subprocess({program, folder_.path(), "-o", output}, scratch.path() / "out"), 0);
    EXPECT_EQ(read_bytes(scratch.path() / "out"),
              "left out: case_04: is not solved yet\n" + output + ": 5 solved cases of 6\n");
}

}  // namespace
}  // namespace samara
