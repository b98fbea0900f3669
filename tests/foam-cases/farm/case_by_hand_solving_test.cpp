// Cases as a user runs them: Allrun, Allclean, and Allrun again, with real OpenFOAM on tiny meshes, below a
// folder whose name holds all that OpenFOAM and shells do not like.

#include <fstream>
#include <map>
#include <regex>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "foam-cases/falls/fall_plan.hpp"
#include "foam-cases/farm/case_folder.hpp"
#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "support/program_run.hpp"
#include "support/temporary_folder.hpp"
#include "test_bodies.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path foam_cases = fs::path(SAMARA_SOURCE_DIRECTORY) / "foam-cases";
const std::string odd_name = "-a \"b\n c;$HOME#\xc3\xa9%*\\&";

using Files = std::map<std::string, std::string>;  // contents by path

// Returns the files of the folder, without following links.
Files files_in(const fs::path& folder) {
    Files files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string name = fs::relative(entry.path(), folder).string();
        if (entry.is_symlink()) {
            files[name] = fs::read_symlink(entry.path()).string();
        } else if (entry.is_regular_file()) {
            files[name] = read_bytes(entry.path());
        }
    }
    return files;
}

// All that was solved: fields, mesh and histories, but not the logs and records with their times.
Files solution_in(const fs::path& folder) {
    Files solution;
    for (const auto& [name, bytes] : files_in(folder)) {
        const bool of_time = name.find("uniform") == std::string::npos && std::isdigit(name.front()) != 0;
        if (of_time || name.starts_with("postProcessing") || name.starts_with("constant")) {
            solution[name] = bytes;
        }
    }
    return solution;
}

class CaseByHand : public testing::Test {
  protected:
    void SetUp() override { fs::create_directories(place_); }

    const test::TemporaryFolder folder_;
    const fs::path place_ = folder_.path() / (odd_name + "'");

    /// Runs a script of the case; what it says is in said().
    [[nodiscard]] int run(const fs::path& folder, std::vector<std::string> words,
                          const std::string& path = "") const {
        words.front() = "./" + words.front();
        if (!path.empty()) words.insert(words.begin(), {"env", "PATH=" + path});
        return run_subprocess(words, folder_ / "said", folder);
    }
    [[nodiscard]] std::string said() const { return read_bytes(folder_ / "said"); }

    static void set_parameters(const fs::path& folder, const std::map<std::string, std::string>& values,
                               const char* file = "parameters") {
        std::string text = read_bytes(folder / file);
        for (const auto& [name, value] : values) {
            const std::string before = text;
            text = std::regex_replace(text, std::regex(fmt::format("\n{} [^;]*;", name)),
                                      fmt::format("\n{} {};", name, value));
            ASSERT_NE(text, before) << name;
        }
        std::ofstream(folder / file) << text;
    }
    static void share_by_two(const fs::path& folder) {
        set_parameters(folder, {{"numberOfSubdomains", "2"}, {"ranksAlong", "(2 1 1)"}},
                       "system/decomposeParDict");
    }

    /// A folder with a tiny case around a sphere, made from the template as a user makes it.
    [[nodiscard]] fs::path flow_case(const std::string& name) const {
        const fs::path folder = place_ / name;
        fs::copy(foam_cases / "templates/body-flow", folder, fs::copy_options::recursive);
        fs::copy_file(foam_cases / "templates/case_files.py", folder / "case_files.py");
        const Body body = test::sphere(0.01);
        fs::create_directories(folder / "constant/triSurface");
        std::ofstream(folder / "constant/triSurface/body.stl")
            << case_surface_stl(body, plan_bake(body, bake_quality("smoke"), 1e4));
        set_parameters(folder, {{"boxHalfWidth", "6"},
                                {"backgroundCells", "12"},
                                {"surfaceLevel", "2"},
                                {"layers", "0"},
                                {"pointInFluid", "(5.217 5.319 5.423)"},
                                {"refinementShells", "((1.2 2) (3 1))"},
                                {"roundIterations", "12"},
                                {"leastIterations", "12"},
                                {"mostIterations", "24"},
                                {"stationarity", "10"}});
        return folder;
    }

    /// A folder with a fall of five steps on the mesh of mesh_11 beside it.
    [[nodiscard]] fs::path fall_case(const std::string& name, Closure closure) const {
        FreeFall fall;
        fall.reynolds_number = 1e4;
        fall.closure = closure;
        fall.volume = 0.52;
        fall.mass = 0.63;
        fall.principal_moments = {0.06, 0.06, 0.06};
        fall.gravity = {0.0, 0.0, -3.0};
        fall.duration = 0.05;
        fall.time_step = 0.01;
        fall.acceleration_relaxation = 0.7;
        const fs::path cases = place_ / (name + ".cases");
        BakePlan plan = plan_falls(test::sphere(0.01), 6000.0, {fall}, fall_model_of(Closure::k_epsilon));
        plan.quality.meshes.front().resolves_boundary_layer = fall_model_of(closure).resolved;
        write_case_folder(cases, test::sphere(0.01), plan, foam_cases);
        const fs::path folder = place_ / name;
        fs::rename(cases / "fall_00", folder);
        set_parameters(folder, {{"roundSteps", "2"}});
        return folder;
    }
};

TEST_F(CaseByHand, OfAFlowGivesTheSameWhenItIsCleanedAndRunAgain) {
    const fs::path flow = flow_case("flow");
    const Files before = files_in(flow);
    ASSERT_EQ(run(flow, {"Allrun"}), 0) << said();
    const Files solution = solution_in(flow);
    for (const char* name : {"12/U", "12/k", "constant/polyMesh/points", "postProcessing/forces/0/force.dat",
                             "postProcessing/nearWake/0/volFieldValue.dat"}) {
        EXPECT_TRUE(solution.contains(name)) << name;
    }
    ASSERT_EQ(run(flow, {"Allclean"}), 0) << said();
    EXPECT_EQ(files_in(flow), before);
    ASSERT_EQ(run(flow, {"Allrun"}), 0) << said();
    EXPECT_EQ(solution_in(flow), solution);
}

// A container, represented by a script that records what it runs and calls the OpenFOAM of this machine.
TEST_F(CaseByHand, RunsEveryProgramOfOpenFoamByTheWordsOfItsContainer) {
    const fs::path flow = flow_case("flow");
    const fs::path container = folder_.path() / "container";
    std::ofstream(container) << "#!/bin/sh\necho \"$1\" >> '" << (folder_ / "ran").string()
                             << "'\nexport WM_PROJECT_DIR=/usr/share/openfoam\nexec \"$@\"\n";
    fs::permissions(container, fs::perms::owner_all);
    share_by_two(flow);
    const std::vector<std::string> words = {"env", "SAMARA_OPENFOAM=" + container.string(), "./Allrun"};
    ASSERT_EQ(run_subprocess(words, folder_ / "said", flow), 0) << said();
    const std::string ran = read_bytes(folder_ / "ran");
    for (const char* program : {"surfaceFeatureExtract", "blockMesh", "snappyHexMesh", "topoSet", "checkMesh",
                                "decomposePar", "simpleFoam", "reconstructPar"}) {
        EXPECT_THAT(ran, HasSubstr(std::string(program) + "\n"));
    }
    std::ofstream(flow / "provenance.json") << "{}";
    const fs::path second = flow_case("second");
    fs::create_directory_symlink("../../flow/constant/polyMesh", second / "constant/polyMesh");
    set_parameters(second, {{"startFrom", "flow"}});
    ASSERT_EQ(run_subprocess(words, folder_ / "said", second), 0) << said();
    EXPECT_THAT(read_bytes(folder_ / "ran"), HasSubstr("mapFields\n"));
    fs::rename(flow, place_ / "mesh_11");
    const fs::path fall = fall_case("fall", Closure::k_epsilon);
    ASSERT_EQ(run_subprocess(words, folder_ / "said", fall), 0) << said();
    EXPECT_THAT(read_bytes(folder_ / "ran"), HasSubstr("pimpleFoam\n"));
}

// Its start is another case's solution, and two processes share it.
TEST_F(CaseByHand, OnTheMeshOfAnotherKeepsThatMeshWhenItIsCleaned) {
    const fs::path first = flow_case("first");
    ASSERT_EQ(run(first, {"Allrun"}), 0) << said();
    std::ofstream(first / "provenance.json") << "{}";
    const Files of_first = files_in(first);
    const fs::path second = flow_case("second one");
    fs::create_directory_symlink("../../first/constant/polyMesh", second / "constant/polyMesh");
    set_parameters(second, {{"startFrom", "first"}});
    share_by_two(second);
    const Files before = files_in(second);
    ASSERT_EQ(run(second, {"Allrun"}), 0) << said();
    EXPECT_THAT(read_bytes(second / "log.simpleFoam"), HasSubstr("nProcs : 2"));
    const nlohmann::json rounds = nlohmann::json::parse(read_bytes(second / "rounds.json"));
    EXPECT_EQ(rounds["attempts"][0]["started_from"], "first");
    ASSERT_EQ(run(second, {"Allclean"}), 0) << said();
    EXPECT_EQ(files_in(second), before);
    EXPECT_EQ(files_in(first), of_first);
}

TEST_F(CaseByHand, StartsFromTheNearestCellsWhereTheInterpolationCrashes) {
    const fs::path first = flow_case("first");
    ASSERT_EQ(run(first, {"Allrun"}), 0) << said();
    std::ofstream(first / "provenance.json") << "{}";
    const fs::path second = flow_case("second");
    fs::create_directory_symlink("../../first/constant/polyMesh", second / "constant/polyMesh");
    set_parameters(second, {{"startFrom", "first"}});
    const fs::path crashing = folder_.file(
        "bin/mapFields",
        "#!/bin/sh\ncase $* in *mapNearest) exec /usr/bin/mapFields \"$@\" ;; esac\nkill -SEGV $$\n");
    fs::permissions(crashing, fs::perms::owner_all);
    const std::string path = crashing.parent_path().string() + ":" + std::getenv("PATH");
    ASSERT_EQ(run(second, {"Allrun"}, path), 0) << said();
    const nlohmann::json rounds = nlohmann::json::parse(read_bytes(second / "rounds.json"));
    EXPECT_EQ(rounds["attempts"][0]["started_from"], "first");
    EXPECT_EQ(rounds["attempts"].size(), 1u);
}

// The models of docs/studies/closures, each with what it needs of the parameters, on one mesh.
TEST_F(CaseByHand, SolvesByTheModelThatItsParametersName) {
    const fs::path first = flow_case("first");
    ASSERT_EQ(run(first, {"Allrun", "mesh"}), 0) << said();
    const std::map<std::string, std::string> resolved = {{"nutAtWall", "nutLowReWallFunction"},
                                                         {"kAtWall", "fixedValue"},
                                                         {"convection", "linearUpwind grad(U)"}};
    const std::map<std::string, std::string> in_time = {
        {"solver", "pimpleFoam"}, {"rateOfChange", "backward"}, {"timeStep", "0.05"}};
    struct Model {
        std::map<std::string, std::string> parameters;
        const char* field;
    };
    const std::map<std::string, Model> models = {
        {"sst",
         {{{"closure", "kOmegaSST"},
           {"solvesForOmega", "yes"},
           {"dissipationField", "turbulenceProperties:epsilon"}},
          "12/turbulenceProperties:epsilon"}},
        {"transition", {{{"closure", "kOmegaSSTLM"}, {"turbulenceMeans", "no"}}, "12/gammaInt"}},
        {"laminar in time", {{{"simulationType", "laminar"}, {"turbulenceMeans", "no"}}, "0.6/U"}},
        {"eddies in time",
         {{{"simulationType", "LES"}, {"closure", "kOmegaSSTDDES"}, {"turbulenceMeans", "no"}},
          "0.6/omega"}}};
    for (const auto& [name, model] : models) {
        const fs::path folder = flow_case(name);
        fs::create_directory_symlink("../../first/constant/polyMesh", folder / "constant/polyMesh");
        set_parameters(folder, resolved);
        set_parameters(folder, model.parameters);
        if (name.ends_with("time")) set_parameters(folder, in_time);
        EXPECT_EQ(run(folder, {"Allrun"}), 0) << name << ": " << said();
        EXPECT_TRUE(fs::exists(folder / model.field)) << name;
        const nlohmann::json rounds = nlohmann::json::parse(read_bytes(folder / "rounds.json"));
        EXPECT_EQ(rounds["attempts"].size(), 1u) << name;
    }
}

TEST_F(CaseByHand, WhoseMeshWasCutShortMakesItAnew) {
    const fs::path flow = flow_case("flow");
    const std::string usual = std::getenv("PATH");
    const fs::path failing = folder_.file("bin/snappyHexMesh", "#!/bin/sh\nexit 1\n");
    fs::permissions(failing, fs::perms::owner_all);
    EXPECT_EQ(run(flow, {"Allrun"}, failing.parent_path().string() + ":" + usual), 1);
    EXPECT_THAT(said(), HasSubstr("snappyHexMesh failed; see "));
    ASSERT_EQ(run(flow, {"Allrun", "mesh"}), 0) << said();
    EXPECT_THAT(read_bytes(flow / "constant/polyMesh/boundary"), HasSubstr("body"));
    EXPECT_FALSE(fs::exists(flow / "constant/polyMesh/unfinished"));
}

TEST_F(CaseByHand, KeepsWhatAllrunDidNotMake) {
    for (const char* name : {"body-flow", "free-fall"}) {
        const fs::path folder = place_ / name;
        fs::copy(foam_cases / "templates" / name, folder, fs::copy_options::recursive);
        for (const char* own :
             {"2nd try/notes", "1.2.3/notes", "0.orig/notes", "7", "constant/polyMesh/points"}) {
            fs::create_directories((folder / own).parent_path());
            std::ofstream(folder / own) << "mine";
        }
        const Files before = files_in(folder);
        for (const char* made :
             {"0/U", "0.25/U", "12/U", "1e-05/U", "postProcessing/forces/0/force.dat", "log.x"}) {
            fs::create_directories((folder / made).parent_path());
            std::ofstream(folder / made) << "solved";
        }
        ASSERT_EQ(run(folder, {"Allclean"}), 0) << said();
        EXPECT_EQ(files_in(folder), before);
    }
}

TEST_F(CaseByHand, IsNotLedAstrayByTheShellsSearchPathForFolders) {
    const fs::path elsewhere = folder_.file("elsewhere/flow/12/U", "mine");
    const fs::path flow = flow_case("flow");
    ASSERT_EQ(run_subprocess({"env", "CDPATH=" + (folder_ / "elsewhere").string(), "flow/Allclean"},
                             folder_ / "said", place_),
              0);
    EXPECT_TRUE(fs::exists(elsewhere));
}

TEST_F(CaseByHand, OfAFallGivesTheSameWhenItIsCleanedAndRunAgain) {
    const fs::path mesh = flow_case("mesh_11");
    ASSERT_EQ(run(mesh, {"Allrun", "mesh"}), 0) << said();
    const fs::path folder = fall_case("fall", Closure::k_epsilon);
    const fs::path linked = folder / "constant" / fs::read_symlink(folder / "constant/polyMesh");
    ASSERT_EQ(linked.lexically_normal(), mesh / "constant/polyMesh");
    const Files before = files_in(folder);
    ASSERT_EQ(run(folder, {"Allrun"}), 0) << said();
    const Files solution = solution_in(folder);
    for (const char* name :
         {"0.04/U", "postProcessing/forces/0/force.dat", "postProcessing/state/0/sixDoFRigidBodyState.dat"}) {
        EXPECT_TRUE(solution.contains(name)) << name;
    }
    ASSERT_EQ(run(folder, {"Allclean"}), 0) << said();
    EXPECT_EQ(files_in(folder), before);
    ASSERT_EQ(run(folder, {"Allrun"}), 0) << said();
    EXPECT_EQ(solution_in(folder), solution);
}

TEST_F(CaseByHand, OfAFallSolvesByTheClosureWithTransition) {
    ASSERT_EQ(run(flow_case("mesh_11"), {"Allrun", "mesh"}), 0) << said();
    const fs::path folder = fall_case("fall", Closure::k_omega_sst_lm);
    ASSERT_EQ(run(folder, {"Allrun"}), 0) << said();
    EXPECT_TRUE(fs::exists(folder / "0.04/gammaInt"));
    EXPECT_THAT(read_bytes(folder / "log.pimpleFoam"), HasSubstr("RAS turbulence model kOmegaSSTLM"));
}

TEST_F(CaseByHand, NeedsNoHandWhereTheWholeBakeIsBelowAnOddName) {
    const fs::path place = folder_.path() / odd_name;
    fs::create_directories(place);
    write_body_file(place / "ball.body.h5", test::sphere(0.01));
    const test::ProgramRun run =
        test::run_program_in(folder_, {"samara-bake", (place / "ball.body.h5").string(), "-o",
                                       (place / "out.body.h5").string(), "--quality", "smoke", "--json"});
    ASSERT_EQ(run.status, 0) << run.error;
    EXPECT_TRUE(read_body_file(place / "out.body.h5").tables.has_value());
}

}  // namespace
}  // namespace samara
