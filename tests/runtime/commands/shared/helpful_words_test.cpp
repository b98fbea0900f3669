// Messages of `samara` about mistakes: misspelt words, names of other formats, notes that many bodies share.

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "samara/core/body/body_file.hpp"
#include "support/known_bodies.hpp"
#include "support/program_run.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using testing::HasSubstr;
using testing::Not;

class HelpfulWords : public ::testing::Test {
  protected:
    HelpfulWords() {
        Body body = test::rubber_ellipsoid();
        body.kirchhoff->error_estimate = 0.3;  // which simulate has a note for
        write_body_file(folder_ / "rubber.body.h5", body);
        body.kirchhoff->error_estimate = 0.5;
        write_body_file(folder_ / "rough.body.h5", body);
        std::string scene = "[scene]\nduration = 0.1\n";
        for (const char* name : {"a", "b", "c", "d"}) {
            scene += std::string("[[body]]\nname = \"") + name + "\"\nshape = \"" +
                     (*name == 'c' ? "rough" : "rubber") + ".body.h5\"\ndensity = 1200\nloads = \"none\"\n";
        }
        (void)folder_.file("scene.toml", scene);
    }
    [[nodiscard]] test::ProgramRun run(std::vector<std::string> words) const {
        words.insert(words.begin(), "samara");
        return run_program_in(folder_, words);
    }
    void expect_rejection(const std::vector<std::string>& words, const std::string& text) const {
        const test::ProgramRun done = run(words);
        EXPECT_EQ(done.status, 1);
        EXPECT_TRUE(test::is_one_line(done.error)) << done.error;
        EXPECT_THAT(done.error, HasSubstr(text));
        EXPECT_EQ(done.output, "");
    }

    const test::TemporaryFolder folder_;
};

TEST_F(HelpfulWords, NameTheCommandOrOptionThatWasMeant) {
    expect_rejection({"simulte", "scene.toml"}, "unknown command 'simulte'; did you mean 'simulate'?");
    expect_rejection({"fly"}, "unknown command 'fly'; see 'samara --help'");
    expect_rejection({"simulate", "scene.toml", "-o", "x.h5", "--sed", "3"},
                     "samara simulate: unknown option '--sed'; did you mean '--seed'?");
    expect_rejection({"simulate", "scene.toml", "-o", "x.h5", "--trheads=2"}, "did you mean '--threads'?");
    expect_rejection({"simulate", "scene.toml", "-o", "x.h5", "--colour"},
                     "unknown option '--colour'; see 'samara simulate --help'");
    expect_rejection({"simulate", "scene.toml", "more.toml", "-o", "x.h5"},
                     "unexpected argument 'more.toml'; leave it out");
}

TEST_F(HelpfulWords, NameTheMisspeltOptionRatherThanTheOneThatItLeavesMissing) {
    expect_rejection({"simulate", "scene.toml", "--ouput", "x.h5"}, "did you mean '--output'?");
    expect_rejection({"simulate", "scene.toml"}, "--output is required");
}

TEST_F(HelpfulWords, OfANumberWithAUnitSayInWhichUnitsNumbersAre) {
    expect_rejection({"export", "x.h5", "-o", "x.glb", "--tolerance", "3mm"},
                     "'3mm' is not a number; give a number without a unit, in SI units: m, kg, s, rad");
    expect_rejection({"search", "scene.toml", "--target", "0,0,0,5cm"}, "x,y,z,radius in metres");
    (void)folder_.file("units.toml", "[scene]\nduration = \"2 s\"\n");
    expect_rejection({"simulate", "units.toml", "-o", "x.h5"},
                     "must be a number without a unit, in SI units (m, kg, s, rad), not \"2 s\"");
}

TEST_F(HelpfulWords, OfAMotionInAnotherFormatNameTheCommandThatWritesIt) {
    expect_rejection({"simulate", "scene.toml", "-o", "x.glb"},
                     "x.glb: the output is a motion file; write x.h5, then 'samara export x.h5 -o x.glb'");
    expect_rejection({"simulate", "scene.toml", "-o", "x.png"}, "then 'samara plot x.h5 -o x.png'");
    expect_rejection({"simulate", "scene.toml", "-o", "x.body.h5"}, "is the name of a body file");
    expect_rejection({"simulate", "scene.toml", "-o", "x"}, "the name of a motion file ends in .h5");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "x.glb"));
}

TEST_F(HelpfulWords, OfASearchWhereNothingIsDrawnComeAtOnceAndSayWhatToAdd) {
    expect_rejection({"search", "scene.toml", "--target", "0,0,0,1", "--body", "a", "--tries", "10000000"},
                     "does not depend on the seed; give a range (--speed");
    EXPECT_EQ(run({"search", "scene.toml", "--target", "0,0,0,1", "--body", "a", "--tries", "1"}).status, 0);
}

TEST_F(HelpfulWords, OfOneKindComeOnceInOneLine) {
    const test::ProgramRun done = run({"simulate", "scene.toml", "-o", "x.h5"});
    ASSERT_EQ(done.status, 0);
    EXPECT_EQ(
        done.error,
        "samara simulate: warning: 'a', 'b' and 2 more (values of 'c'): the added mass may be off by 50 % "
        "(error estimate): the body is thin or its mesh is coarse\n");
}

TEST_F(HelpfulWords, OfUnitsAreOneLineForThoseThatSayTheSame) {
    std::string scene = "[scene]\nduration = 0.1\n";
    for (const char* name : {"a", "b", "c"}) {
        scene += std::string("[[body]]\nname = \"") + name +
                 "\"\nshape = \"rubber.body.h5\"\nadded_mass = false\n" +
                 "loads = \"none\"\ndensity = " + (*name == 'c' ? "0.6" : "2.7") + "\n";
    }
    (void)folder_.file("light.toml", scene);
    const test::ProgramRun done = run({"simulate", "light.toml", "-o", "x.h5"});
    ASSERT_EQ(done.status, 0);
    EXPECT_THAT(done.error,
                testing::StartsWith("samara simulate: warning: 'a' and 'b': a density of 2.7 kg/m^3"));
    EXPECT_THAT(done.error, HasSubstr("samara simulate: warning: 'c': a density of 0.6 kg/m^3"));
}

TEST_F(HelpfulWords, AreJsonWithJsonWhateverIsWrong) {
    const auto error_of = [&](const std::vector<std::string>& words) {
        const test::ProgramRun done = run(words);
        EXPECT_EQ(done.status, 1);
        EXPECT_TRUE(test::is_one_line(done.output)) << done.output;
        EXPECT_TRUE(test::is_one_line(done.error)) << done.error;
        EXPECT_EQ(done.json().size(), 1U);
        return done.json()["error"].get<std::string>();
    };
    EXPECT_EQ(error_of({"simulate", "none.toml", "-o", "x.h5", "--json"}),
              "none.toml: does not exist; check the name");
    EXPECT_EQ(error_of({"simulate", "--json", "--sed", "3"}),
              "unknown option '--sed'; did you mean '--seed'?");
    EXPECT_THAT(error_of({"nonsense", "--json"}), HasSubstr("unknown command 'nonsense'"));
    EXPECT_THAT(run({"info", "\xff\x1b[2J.h5", "--json"}).output, Not(HasSubstr("\x1b")));
}

}  // namespace
}  // namespace samara
