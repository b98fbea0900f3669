#include "foam-cases/farm/case_folder.hpp"

#include <cmath>
#include <fstream>
#include <regex>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "paths.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "test_bodies.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

const fs::path foam_cases = fs::path(SAMARA_SOURCE_DIRECTORY) / "foam-cases";

BakePlan smoke_of(const Body& body, double reynolds_number = 1e4) {
    return plan_bake(body, bake_quality("smoke"), reynolds_number);
}

std::string entry_of(const std::string& parameters, const std::string& name) {
    std::smatch match;
    const std::regex line("(?:^|\\n)" + name + " +([^;]*);");
    return std::regex_search(parameters, match, line) ? match[1].str() : "";
}

void write(const fs::path& path, const std::string& text) {
    std::ofstream(path) << text;
}

// Stands for a solve: writes the records that the checks write at its end.
void pretend_solved(const fs::path& folder) {
    const auto plan = nlohmann::json::parse(read_bytes(folder / "plan.json"));
    fs::create_directories(folder / "mesh_coarse/constant/polyMesh");
    write(folder / "mesh_coarse/constant/polyMesh/cellZones", "FoamFile { format ascii; }\n");
    write(folder / "mesh_coarse/mesh.json",
          nlohmann::json({{"inputs_hash", plan["meshes"][0]["inputs_hash"]}}).dump());
    for (const auto& entry : plan["cases"]) {
        write(folder / entry["name"].get<std::string>() / "provenance.json",
              nlohmann::json({{"inputs_hash", entry["inputs_hash"]}}).dump());
    }
}

class CaseFolder : public testing::Test {
  protected:
    const Body body_ = test::ellipsoid({0.01, 0.02, 0.04});
    const BakePlan plan_ = smoke_of(body_);
    const test::TemporaryFolder temporary_;
    const fs::path folder_ = temporary_.path() / "body.cases";

    [[nodiscard]] bool mesh_is_made() const { return fs::exists(folder_ / "mesh_coarse/mesh.json"); }
    [[nodiscard]] bool first_is_solved() const {
        return fs::exists(folder_ / plan_.cases[0].name / "provenance.json");
    }
};

TEST_F(CaseFolder, HoldsAPlainCaseForEachDirectionOnOneMesh) {
    write_case_folder(folder_, body_, plan_, foam_cases);
    EXPECT_TRUE(fs::exists(folder_ / case_body_name));
    for (const BakeCase& entry : plan_.cases) {
        const fs::path one = folder_ / entry.name;
        EXPECT_TRUE(fs::exists(one / "system/controlDict"));
        EXPECT_NE(fs::status(one / "Allrun").permissions() & fs::perms::owner_exec, fs::perms::none);
        const fs::path link = one / "constant/polyMesh";
        EXPECT_EQ((link.parent_path() / fs::read_symlink(link)).lexically_normal(),
                  folder_ / "mesh_coarse/constant/polyMesh");
        const std::string parameters = read_bytes(one / "parameters");
        std::istringstream numbers(entry_of(parameters, "flowVelocity").substr(1));
        Vector3d flow;
        numbers >> flow.x() >> flow.y() >> flow.z();
        EXPECT_NEAR((flow + entry.direction).norm(), 0.0, 1e-12);
        EXPECT_EQ(std::stod(entry_of(parameters, "viscosity")), 1e-4);
    }
}

TEST_F(CaseFolder, AveragesKAndEpsilonBySecondOrderInTheCasesThatTheTablesTakeThemFrom) {
    const BakePlan plan = plan_bake(body_, with_loads_by(Closure::k_omega_sst_lm, bake_quality("high")), 1e4);
    const std::string text = read_bytes(foam_cases / "templates/body-flow/parameters");
    std::size_t of_omega = 0;
    for (const BakeCase& entry : plan.cases) {
        const std::string parameters = case_parameters(text, plan, entry);
        const bool averages = entry.mesh.ends_with("_turbulence") && entry.closure != Closure::laminar;
        EXPECT_EQ(entry_of(parameters, "turbulenceMeans"), averages ? "yes" : "no") << entry.name;
        if (!averages) continue;
        EXPECT_EQ(entry_of(parameters, "convection"), "linearUpwind grad(U)");
        EXPECT_EQ(entry_of(parameters, "turbulenceConvection"), "limitedLinear 1");
        const bool omega = entry.closure == Closure::k_omega_sst;
        of_omega += omega ? 1 : 0;
        EXPECT_EQ(entry_of(parameters, "solvesForOmega"), omega ? "yes" : "no");
        EXPECT_EQ(entry_of(parameters, "dissipationField"),
                  omega ? "turbulenceProperties:epsilon" : "epsilon");
    }
    EXPECT_GT(of_omega, 0U);
}

TEST_F(CaseFolder, CanBeOpenedByParaviewAndCopiedWithoutLinksThatLeadOutOfIt) {
    write_case_folder(folder_, body_, plan_, foam_cases);
    std::size_t opened = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
        if (entry.path().extension() == ".foam") ++opened;
        if (!entry.is_symlink()) continue;
        const auto target = std::filesystem::weakly_canonical(entry.path().parent_path() /
                                                              std::filesystem::read_symlink(entry.path()));
        const auto within = std::filesystem::relative(target, std::filesystem::canonical(folder_)).string();
        EXPECT_FALSE(within.starts_with("..")) << entry.path();
    }
    EXPECT_EQ(opened, plan_.cases.size() + plan_.all_meshes().size());
    EXPECT_TRUE(std::filesystem::exists(folder_ / plan_.cases[0].name / "case.foam"));
    EXPECT_THAT(read_bytes(folder_ / "README"), testing::HasSubstr("cp -rL"));
}

TEST_F(CaseFolder, MakesAScriptExecutableThatAKillLeftWithoutTheRight) {
    write_case_folder(folder_, body_, plan_, foam_cases);
    const fs::path script = folder_ / plan_.cases.front().name / "Allrun";
    fs::permissions(script, fs::perms::owner_exec, fs::perm_options::remove);
    write_case_folder(folder_, body_, plan_, foam_cases);
    EXPECT_NE(fs::status(script).permissions() & fs::perms::owner_exec, fs::perms::none);
}

TEST_F(CaseFolder, DiffersFromCaseToCaseInParametersAlone) {
    write_case_folder(folder_, body_, plan_, foam_cases);
    for (const auto& file : fs::recursive_directory_iterator(folder_ / plan_.cases[0].name)) {
        if (!file.is_regular_file()) continue;
        const fs::path name = fs::relative(file.path(), folder_ / plan_.cases[0].name);
        const bool equal = read_bytes(file.path()) == read_bytes(folder_ / plan_.cases[1].name / name);
        EXPECT_EQ(equal, name != "parameters") << name;
    }
}

TEST_F(CaseFolder, KeepsWhatWasSolvedOnEqualInputs) {
    write_case_folder(folder_, body_, plan_, foam_cases);
    pretend_solved(folder_);
    const auto written = fs::last_write_time(folder_ / plan_.cases[0].name / "parameters");
    write_case_folder(folder_, body_, plan_, foam_cases);
    EXPECT_TRUE(mesh_is_made());
    EXPECT_TRUE(first_is_solved());
    EXPECT_EQ(fs::last_write_time(folder_ / plan_.cases[0].name / "parameters"), written);
}

TEST_F(CaseFolder, SolvesAgainButKeepsTheMeshAtAnotherReynoldsNumber) {
    write_case_folder(folder_, body_, plan_, foam_cases);
    pretend_solved(folder_);
    write_case_folder(folder_, body_, smoke_of(body_, 2e4), foam_cases);
    EXPECT_TRUE(mesh_is_made());
    EXPECT_FALSE(first_is_solved());
}

TEST_F(CaseFolder, MakesEverythingAgainForAnotherBody) {
    write_case_folder(folder_, body_, plan_, foam_cases);
    pretend_solved(folder_);
    const Body other = test::ellipsoid({0.01, 0.02, 0.03});
    write_case_folder(folder_, other, smoke_of(other), foam_cases);
    EXPECT_FALSE(mesh_is_made());
    EXPECT_FALSE(first_is_solved());
}

TEST_F(CaseFolder, MakesTheMeshAgainWhereItWasRemoved) {
    write_case_folder(folder_, body_, plan_, foam_cases);
    pretend_solved(folder_);
    fs::remove_all(folder_ / "mesh_coarse/constant/polyMesh");
    write_case_folder(folder_, body_, plan_, foam_cases);
    EXPECT_FALSE(mesh_is_made());
}

TEST_F(CaseFolder, PutsBackAFileThatWasChangedByHand) {
    write_case_folder(folder_, body_, plan_, foam_cases);
    const fs::path schemes = folder_ / plan_.cases[0].name / "system/fvSchemes";
    const std::string before = read_bytes(schemes);
    write(schemes, "something else");
    write_case_folder(folder_, body_, plan_, foam_cases);
    EXPECT_EQ(read_bytes(schemes), before);
}

// Unsafe entries in a folder of another origin: each is rejected with its name, and its target stays
// as it is.
class StrangeCaseFolder : public CaseFolder {
  protected:
    void SetUp() override {
        write_case_folder(folder_, body_, plan_, foam_cases);
        pretend_solved(folder_);
    }
    [[nodiscard]] fs::path first() const { return folder_ / plan_.cases[0].name; }
    /// Returns the error about the folder, after the path of the file.
    [[nodiscard]] std::string error_of(const fs::path& file) const {
        const std::string said =
            test::error_of([&] { write_case_folder(folder_, body_, plan_, foam_cases); });
        EXPECT_THAT(said, testing::StartsWith(file.string() + ":"));
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
        return said;
    }
    void expect_rejected(const fs::path& file, const std::string& text = "strange\n") const {
        fs::create_directories(file.parent_path());
        write(file, text);
        (void)error_of(file);
        fs::remove_all(file);
        EXPECT_NO_THROW(write_case_folder(folder_, body_, plan_, foam_cases));
    }
};

TEST_F(StrangeCaseFolder, WithAFileThatIsNeitherAnInputNorAResultIsRejected) {
    for (const char* name :
         {"json.py", "fvOptions", "remedy", "case_files.cpython-311-x86_64-linux-gnu.so", "system/fvOptions",
          "system/functions", "constant/fvOptions", "constant/dynamicMeshDict", "0.orig/alpha", "12/U.gz"}) {
        expect_rejected(first() / name);
    }
    for (const char* name : {"json.py", "Snakefile", "snakemake.py", "config.yaml"})
        expect_rejected(folder_ / name);
    expect_rejected(folder_ / "mesh_coarse/system/fvOptions");
}

TEST_F(StrangeCaseFolder, WithAFolderOfAnotherOriginIsRejected) {
    for (const char* name : {"dynamicCode", "__pycache__", "case_files", "system/include", "constant/lib"}) {
        const fs::path folder = first() / name;
        fs::create_directories(folder);
        EXPECT_THAT(error_of(folder),
                    testing::HasSubstr("is a folder that neither samara nor OpenFOAM creates here"));
        fs::remove(folder);
    }
    fs::create_directories(folder_ / "profiles/default");
    EXPECT_THAT(error_of(folder_ / "profiles"), testing::HasSubstr("not created by samara; move it out"));
}

TEST_F(StrangeCaseFolder, WritesThroughNoLink) {
    const fs::path elsewhere = temporary_.file("elsewhere/mine", "untouched");
    for (const char* name : {"parameters", "log.simpleFoam", "round", "case.foam", "12/U",
                             "postProcessing/forces/0/force.dat"}) {
        const fs::path link = first() / name;
        fs::remove(link);
        fs::create_directories(link.parent_path());
        fs::create_symlink(elsewhere, link);
        EXPECT_THAT(error_of(link), testing::HasSubstr("is a link, which is not followed here"));
        fs::remove(link);
    }
    for (const char* name : {"system", "constant", "0.orig"}) {
        fs::remove_all(first() / name);
        fs::create_directory_symlink(elsewhere.parent_path(), first() / name);
        (void)error_of(first() / name);
        fs::remove(first() / name);
    }
    for (const char* name : {"plan.json", "README", "log.snakemake", "body.body.h5"}) {
        fs::remove(folder_ / name);
        fs::create_symlink(elsewhere, folder_ / name);
        (void)error_of(folder_ / name);
        fs::remove(folder_ / name);
    }
    EXPECT_EQ(read_bytes(elsewhere), "untouched");
    EXPECT_EQ(std::distance(fs::directory_iterator(elsewhere.parent_path()), {}), 1);
}

TEST_F(StrangeCaseFolder, ThatIsALinkIsNoFolder) {
    fs::rename(folder_, temporary_.path() / "elsewhere");
    fs::create_directory_symlink(temporary_.path() / "elsewhere", folder_);
    EXPECT_THAT(error_of(folder_), testing::HasSubstr("is a link, but"));
}

TEST_F(StrangeCaseFolder, PutsAnInputOfTwoNamesInItsPlaceAlone) {
    const fs::path elsewhere = temporary_.file("elsewhere", "untouched");
    fs::remove(first() / "parameters");
    fs::create_hard_link(elsewhere, first() / "parameters");
    write_case_folder(folder_, body_, plan_, foam_cases);
    EXPECT_EQ(read_bytes(elsewhere), "untouched");
}

TEST_F(StrangeCaseFolder, LeadsToItsOwnMeshAlone) {
    const fs::path elsewhere = temporary_.file("elsewhere/points", "untouched");
    const fs::path link = first() / "constant/polyMesh";
    fs::remove(link);
    fs::create_directory_symlink(elsewhere.parent_path(), link);
    write_case_folder(folder_, body_, plan_, foam_cases);
    EXPECT_EQ(fs::read_symlink(link), "../../mesh_coarse/constant/polyMesh");
    EXPECT_EQ(read_bytes(elsewhere), "untouched");
}

TEST_F(StrangeCaseFolder, WithAPipeIsRejected) {
    const fs::path pipe = first() / "log.simpleFoam";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THAT(error_of(pipe), testing::HasSubstr("is neither a file nor a folder"));
}

TEST_F(StrangeCaseFolder, WhoseFieldsOrMeshHoldMoreThanDataIsRejected) {
    const std::string field =
        "FoamFile { version 2.0; format ascii; class volVectorField; object U; }\ninternalField ";
    fs::create_directories(first() / "12");
    write(first() / "12/U", field + "uniform (1 0 0);\n");
    EXPECT_NO_THROW(write_case_folder(folder_, body_, plan_, foam_cases));
    for (const fs::path& file :
         {first() / "12/U", first() / "0/U", folder_ / "mesh_coarse/constant/polyMesh/boundary"}) {
        fs::create_directories(file.parent_path());
        write(file, field + "#calc \"system(\\\"x\\\")\";\n");
        EXPECT_THAT(error_of(file),
                    testing::HasSubstr(":2: holds '#calc', which is not allowed there; remove the folder "));
        fs::remove(file);
    }
    fs::copy_file(first() / "0.orig/U", first() / "0/U");
    EXPECT_NO_THROW(write_case_folder(folder_, body_, plan_, foam_cases));
}

TEST_F(StrangeCaseFolder, KeepsWhatRunsLeaveBehind) {
    for (const char* name :
         {"log.simpleFoam", "round", "rounds.json", "rounds.json.part", "0/uniform/time", "12/uniform/time",
          "postProcessing/nearWake/0/volFieldValue.dat", "processor0/12/U"}) {
        fs::create_directories((first() / name).parent_path());
        write(first() / name,
              name == std::string("12/uniform/time") ? "FoamFile { format ascii; }\nvalue 12;\n" : "");
    }
    fs::create_symlink("../direction_01_coarse", first() / "startCase");
    write(folder_ / "mesh_coarse/remedy", "layers 0;\n");
    write(folder_ / ".samara.0123456789ab.77.1.tmp", "");
    fs::create_directories(folder_ / "fall_07");
    EXPECT_NO_THROW(write_case_folder(folder_, body_, plan_, foam_cases, Unplanned::kept));
    EXPECT_TRUE(first_is_solved());
}

TEST_F(CaseFolder, SolvesAgainWhatStartsFromACaseWhoseInputsChanged) {
    const BakePlan before = plan_bake(body_, bake_quality("preview"), 1e4);
    write_case_folder(folder_, body_, before, foam_cases);
    const auto hash_of = [&](const std::string& name) {
        const auto plan = nlohmann::json::parse(read_bytes(folder_ / "plan.json"));
        for (const auto& entry : plan["cases"]) {
            if (entry["name"] == name) return entry["inputs_hash"].get<std::string>();
        }
        return std::string();
    };
    const std::string medium = hash_of("direction_00_medium");
    ASSERT_NE(medium, "");
    BakePlan changed = before;
    changed.quality.meshes.front().layers += 1;
    write_case_folder(folder_, body_, changed, foam_cases);
    EXPECT_NE(hash_of("direction_00_medium"), medium);
}

TEST_F(CaseFolder, LosesCasesThatAreNoLongerPlanned) {
    write_case_folder(folder_, body_, plan_, foam_cases);
    const Body ball = test::sphere(0.01);
    write_case_folder(folder_, ball, smoke_of(ball), foam_cases);
    EXPECT_TRUE(fs::exists(folder_ / "direction_00_coarse"));
    EXPECT_FALSE(fs::exists(folder_ / "direction_01_coarse"));
}

TEST(CaseSurface, IsInUnitsOfLAboutTheCentroidInCaseAxes) {
    Body body = test::ellipsoid({0.01, 0.02, 0.04}, {5.0, 6.0, 7.0}, 5);
    body.symmetry.axes << 0, 0, 1, 1, 0, 0, 0, 1, 0;  // case x along body y, y along z, z along x
    const BakePlan plan = smoke_of(body);
    std::istringstream stl(case_surface_stl(body, plan));
    Eigen::Array3d largest = Eigen::Array3d::Zero();
    double volume = 0.0;
    std::vector<Vector3d> corners;
    for (std::string word; stl >> word;) {
        if (word != "vertex") continue;
        Vector3d corner;
        stl >> corner.x() >> corner.y() >> corner.z();
        largest = largest.max(corner.array().abs());
        corners.push_back(corner);
        if (corners.size() % 3 == 0) {
            const std::size_t last = corners.size() - 1;
            volume += corners[last - 2].dot(corners[last - 1].cross(corners[last])) / 6.0;
        }
    }
    EXPECT_EQ(corners.size(), 3 * body.surface.triangle_count());
    const Eigen::Array3d expected = Eigen::Array3d(0.02, 0.04, 0.01) / plan.reference_length;
    EXPECT_LT((largest - expected).abs().maxCoeff(), 1e-8);
    const double exact = body.moments.volume / std::pow(plan.reference_length, 3.0);
    EXPECT_NEAR(volume, exact, 5e-3 * exact);  // positive: the normals point outwards
}

TEST(CaseSurface, FollowsTheEdgeNodesOfCurvedTriangles) {
    Body body = test::sphere(0.01, 1);
    const std::size_t flat = body.surface.triangle_count();
    for (const auto& corners : body.surface.corners) {
        std::array<std::int32_t, 3> nodes{};
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector3d sum = body.surface.vertices[static_cast<std::size_t>(corners[i])] +
                                 body.surface.vertices[static_cast<std::size_t>(corners[(i + 1) % 3])];
            nodes[i] = static_cast<std::int32_t>(body.surface.vertices.size());
            body.surface.vertices.push_back(0.01 * sum.normalized());
        }
        body.surface.edge_nodes.push_back(nodes);
    }
    const std::string stl = case_surface_stl(body, smoke_of(body));
    std::size_t facets = 0;
    for (std::size_t at = stl.find("outer loop"); at != std::string::npos;
         at = stl.find("outer loop", at + 1)) {
        ++facets;
    }
    EXPECT_EQ(facets, 4 * flat);
}

double number_in(const std::string& parameters, const std::string& name) {
    return std::stod(entry_of(parameters, name));
}

TEST(CaseParameters, GiveTheInflowTheStatedIntensityAndTheFluidsViscosity) {
    const BakePlan plan = smoke_of(test::sphere(0.01), 2000.0);
    const std::string text =
        case_parameters(read_bytes(foam_cases / "templates/body-flow/parameters"), plan, plan.cases[0]);
    const double k = number_in(text, "inflowK");
    EXPECT_NEAR(std::sqrt(2.0 / 3.0 * k), Inflow().intensity, 1e-8);
    EXPECT_NEAR(0.09 * k * k / number_in(text, "inflowEpsilon"), 1.0 / 2000.0, 1e-8);
    EXPECT_NEAR(number_in(text, "inflowNut"), 1.0 / 2000.0, 1e-8);
}

TEST(CaseParameters, GiveThePapersInflow) {
    const BakePlan plan = plan_bake(test::sphere(0.01), bake_quality("smoke"), 2000.0, paper_inflow());
    const std::string text =
        case_parameters(read_bytes(foam_cases / "templates/body-flow/parameters"), plan, plan.cases[0]);
    EXPECT_NEAR(number_in(text, "inflowK"), 1.5, 1e-8);
    EXPECT_NEAR(number_in(text, "inflowEpsilon"), std::pow(0.09, 0.75) * std::pow(1.5, 1.5) / 0.25, 1e-5);
}

TEST(CaseParameters, MakeALaminarCaseBelowTheStatedReynoldsNumber) {
    const BakePlan plan = smoke_of(test::sphere(0.01), 100.0);
    const std::string text =
        case_parameters(read_bytes(foam_cases / "templates/body-flow/parameters"), plan, plan.cases[0]);
    EXPECT_EQ(entry_of(text, "simulationType"), "laminar");
}

TEST(CaseParameters, KeepWhatTheTemplateSaysBeside) {
    const BakePlan plan = smoke_of(test::sphere(0.01));
    const std::string text =
        read_bytes(foam_cases / "templates/body-flow/parameters") + "mine 3;  // my own\n";
    EXPECT_NE(case_parameters(text, plan, plan.cases[0]).find("mine 3;  // my own\n"), std::string::npos);
}

TEST(CaseParameters, NameTheEntryThatATemplateLacks) {
    const BakePlan plan = smoke_of(test::sphere(0.01));
    try {
        case_parameters("direction (1 0 0);\n", plan, plan.cases[0]);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("'flowVelocity'"), std::string::npos);
    }
}

}  // namespace
}  // namespace samara
