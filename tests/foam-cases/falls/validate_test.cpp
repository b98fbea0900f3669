// Errors of samara validate, each in one line, before anything is solved.

#include "foam-cases/falls/validate.hpp"

#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/core/body/body_file.hpp"
#include "support/program_run.hpp"
#include "support/temporary_folder.hpp"
#include "test_bodies.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Validate : public testing::Test {
  protected:
    Validate() { write_body_file(folder_.path() / "ball.body.h5", test::sphere(0.02)); }

    /// `scene`, `fluid` and `body`: further lines of these tables.
    void write_scene(const std::string& scene, const std::string& fluid, const std::string& body) {
        static_cast<void>(folder_.file(
            "scene.toml", fmt::format("[scene]\nduration = 1\n{}\n[fluid]\npreset = \"water\"\n{}\n[[body]]\n"
                                      "name = \"ball\"\nshape = \"ball.body.h5\"\n{}\n",
                                      scene, fluid, body)));
    }
    [[nodiscard]] test::ProgramRun validate(const std::vector<std::string>& more,
                                            const std::string& environment = "") const {
        std::vector<std::string> words = {"samara-validate", "scene.toml", "-o", "out.h5"};
        words.insert(words.end(), more.begin(), more.end());
        return test::run_program_in(folder_, words, environment);
    }
    /// Returns the one line of an error.
    [[nodiscard]] std::string error(const std::vector<std::string>& more = {},
                                    const std::string& environment = "") const {
        const test::ProgramRun run = validate(more, environment);
        EXPECT_EQ(run.status, 1);
        EXPECT_TRUE(test::is_one_line(run.error)) << run.error;
        EXPECT_EQ(run.output, "");
        EXPECT_FALSE(fs::exists(folder_.path() / "out.h5"));
        EXPECT_FALSE(fs::exists(folder_.path() / "out.cases"));
        return run.error;
    }

    test::TemporaryFolder folder_;
};

TEST_F(Validate, RejectsNamesThatMotionFilesDoNotHave) {
    write_scene("", "", "density = 1200\nturbulence = \"none\"");
    const test::ProgramRun run =
        test::run_program_in(folder_, {"samara-validate", "scene.toml", "-o", "out.glb"});
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.error,
                HasSubstr("out.glb: the output is a motion file; write out.h5, then 'samara export"));
}

TEST_F(Validate, RejectsScenesThatFullCfdDoesNotSolve) {
    const std::string body = "density = 1200\nturbulence = \"none\"";
    write_scene("", "", body + "\n[[body]]\nname = \"other\"\nshape = \"ball.body.h5\"\ndensity = 1200");
    EXPECT_THAT(error(), HasSubstr("scene.toml: full CFD solves one body at a time"));
    write_scene("", "", body + "\ncount = 3\nspread = { size = [0.9, 1.1] }");
    EXPECT_THAT(error(), HasSubstr("copies; remove 'size' from 'spread'"));
    write_scene("ground = -2.0", "", body);
    EXPECT_THAT(error(), HasSubstr("'ground'"));
    std::ofstream(folder_ / "roof.stl") << "solid roof\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                                           "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";
    write_scene("", "", body + "\n[[obstacle]]\nname = \"roof\"\nshape = \"roof.stl\"");
    EXPECT_THAT(error(), HasSubstr("[[obstacle]]"));
    write_scene("", "", body + "\n[wind]\nvelocity = [1, 0, 0]");
    EXPECT_THAT(error(), HasSubstr("[wind]"));
    write_scene("", "gust = { amplitude = [0.1, 0, 0], period = 1.0 }", body);
    EXPECT_THAT(error(), HasSubstr("'gust'"));
    write_scene("", "", body + "\nstart = 1.5");
    EXPECT_THAT(error(), HasSubstr("ends before its body starts"));
    write_scene("", "", body + "\ncount = 2\nstart = 0.5\nspread = { start = 0.6 }");
    EXPECT_THAT(error(), HasSubstr("ends before its body starts"));
}

TEST_F(Validate, RejectsABodyThatNothingMoves) {
    write_scene("", "", "density = 998.2\nturbulence = \"none\"");
    EXPECT_THAT(error({"--dry-run"}), HasSubstr("'ball' is as dense as the fluid"));
    write_scene("gravity = [0, 0, 0]", "", "density = 1200\nturbulence = \"none\"");
    EXPECT_THAT(error({"--dry-run"}), HasSubstr("so it does not fall"));
}

TEST_F(Validate, NamesTheProgramsThatAreMissing) {
    write_scene("", "", "density = 1200\nturbulence = \"none\"");
    const std::string text = error({}, "PATH=/nowhere");
    EXPECT_THAT(text, HasSubstr("solving needs programs that are not on PATH"));
    EXPECT_THAT(text, HasSubstr("pimpleFoam"));
    EXPECT_THAT(text, HasSubstr("apt install openfoam snakemake"));
}

TEST_F(Validate, NamesTheContainerThatRunsNoOpenFoam) {
    write_scene("", "", "density = 1200\nturbulence = \"none\"");
    EXPECT_THAT(error({}, "SAMARA_OPENFOAM=false"),
                HasSubstr("needs OpenFOAM, but 'false simpleFoam -help' fails with exit status 1; set "
                          "SAMARA_OPENFOAM to the command that runs a program in its container"));
    EXPECT_THAT(error({}, "SAMARA_OPENFOAM=/nowhere/apptainer"),
                HasSubstr("'/nowhere/apptainer simpleFoam -help' fails with exit status 127"));
}

TEST_F(Validate, RejectsNumbersOutOfRangeAndFilesThatAreNone) {
    write_scene("", "", "density = 1200\nturbulence = \"none\"");
    EXPECT_THAT(error({"--cells", "10"}), HasSubstr("--cells"));
    EXPECT_THAT(error({"--step", "0"}), HasSubstr("--step"));
    EXPECT_THAT(error({"--cluster", "qsub"}), HasSubstr("sbatch"));
    EXPECT_THAT(error({"--other-mesh", "nowhere.h5"}), HasSubstr("nowhere.h5"));
    EXPECT_THAT(error({"--other-closure", "ball.body.h5"}), HasSubstr("not a motion file"));
    EXPECT_THAT(error({"--other-closure", "a.h5,b.h5,c.h5"}), HasSubstr("one motion file, or two"));
}

TEST_F(Validate, SaysInADryRunWhatItWouldSolve) {
    write_scene("", "", "density = 1200\nturbulence = \"none\"");
    const test::ProgramRun plain = validate({"--dry-run"});
    EXPECT_EQ(plain.status, 0) << plain.error;
    EXPECT_THAT(plain.output, HasSubstr("steps of"));
    const test::ProgramRun run = validate({"--dry-run", "--json", "--step", "0.5", "--cells", "6000"});
    ASSERT_EQ(run.status, 0) << run.error;
    const nlohmann::json json = run.json();
    EXPECT_EQ(json["closure"], "kOmegaSSTLM");
    EXPECT_NEAR(json["estimated_cells"].get<double>(), 6000.0, 1200.0);
    EXPECT_NEAR(json["steps"].get<double>() * json["time_step"].get<double>(), 1.0, 1e-9);
    EXPECT_GT(json["estimated_cpu_seconds"].get<double>(), 1.0);
    EXPECT_FALSE(fs::exists(folder_.path() / "out.cases"));
}

TEST_F(Validate, SolvesAFallForEachCopy) {
    write_scene("", "", "density = 1200\nturbulence = \"none\"");
    const nlohmann::json one = validate({"--dry-run", "--json"}).json();
    write_scene("", "", "density = 1200\nturbulence = \"none\"\ncount = 3\nspread = { angle = 0.1 }");
    const nlohmann::json three = validate({"--dry-run", "--json"}).json();
    EXPECT_EQ(one["falls"], 1);
    EXPECT_EQ(three["falls"], 3);
    EXPECT_EQ(three["steps"], one["steps"]);
    EXPECT_GT(three["estimated_cpu_seconds"].get<double>(), 2.0 * one["estimated_cpu_seconds"].get<double>());
    EXPECT_THAT(validate({"--dry-run"}).output, HasSubstr("3 falls, each: "));
}

TEST_F(Validate, SolvesByAnotherClosureWhereOneIsNamed) {
    write_scene("", "", "density = 1200\nturbulence = \"none\"");
    const auto plan = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {"--dry-run", "--json"};
        words.insert(words.end(), more.begin(), more.end());
        return validate(words).json();
    };
    const nlohmann::json functions = plan({"--closure", "kEpsilon", "--cells", "6000"});
    EXPECT_EQ(functions["mesh"], "mesh_11");
    EXPECT_EQ(functions["closure"], "kEpsilon");
    EXPECT_LT(functions["time_step"].get<double>(), plan({})["time_step"].get<double>());
    EXPECT_EQ(plan({"--closure", "laminar"})["closure"], "laminar");
    EXPECT_EQ(plan({"--closure", "kOmegaSSTDDES"})["closure"], "kOmegaSSTDDES");
    EXPECT_THAT(error({"--closure", "kOmega"}),
                HasSubstr("choose kOmegaSSTLM, kOmegaSST, kOmegaSSTDDES, laminar or kEpsilon"));
}

TEST_F(Validate, LeavesTheCasesOfABakeAlone) {
    write_scene("", "", "density = 1200\nturbulence = \"none\"");
    static_cast<void>(folder_.file("out.cases/plan.json", R"({"quality": "standard", "cases": []})"));
    const test::ProgramRun run = validate({});
    EXPECT_EQ(run.status, 1);
    EXPECT_TRUE(test::is_one_line(run.error)) << run.error;
    EXPECT_THAT(run.error, HasSubstr("out.cases: holds the cases of samara bake"));
    EXPECT_TRUE(fs::exists(folder_.path() / "out.cases/plan.json"));
}

}  // namespace
}  // namespace samara
