#include <cstdlib>
#include <filesystem>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "paths.hpp"
#include "samara/core/base/text.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/reports/bake_verdict.hpp"
#include "samara/reports/report_blocks.hpp"
#include "samara/reports/report_program.hpp"
#include "support/known_bodies.hpp"
#include "support/program_run.hpp"

namespace samara {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::filesystem::path shipped = std::filesystem::path(SAMARA_SOURCE_DIRECTORY) / "runtime" / "bodies";

/// The rubber ellipsoid with tables of all sources of errors, `share` of each quantity, and coefficients.
Body well_baked(double share) {
    Body body = test::lopsided_shape();
    body.symmetry = test::rubber_ellipsoid().symmetry;
    body.kirchhoff = test::rubber_ellipsoid().kirchhoff;
    body.tables->quality = "high";
    body.tables->error_sources.clear();
    for (const ErrorSource source :
         {ErrorSource::tail, ErrorSource::mesh, ErrorSource::closure, ErrorSource::interpolation}) {
        body.tables->error_sources.push_back({source, 0.5 * share, 0.5 * share, 0.5 * share, 0.5 * share});
    }
    return body;
}

std::vector<std::string> of_grade(const BakeVerdict& verdict, Grade grade) {
    std::vector<std::string> names;
    for (const Finding& finding : verdict.findings) {
        if (finding.grade == grade) names.push_back(finding.what);
    }
    return names;
}

TEST(BakeVerdict, IsGoodForMetricsWhereErrorsAreSmallAndFallsWereSolved) {
    const BakeVerdict verdict = judge_bake(well_baked(0.08));
    EXPECT_EQ(verdict.grade, Grade::good) << as_json(verdict).dump(1);
    EXPECT_EQ(verdict.headline, "Good for metrics of falls, and for pictures.");
    EXPECT_EQ(verdict.good_for.size(), 4U);
    EXPECT_THAT(verdict.not_for, IsEmpty());
    EXPECT_THAT(verdict.good_for,
                Contains(HasSubstr("descent speeds, which the tables make uncertain by 4 %")));
}

TEST(BakeVerdict, IsForPicturesAloneWhereTheForceIsUncertain) {
    const BakeVerdict verdict = judge_bake(well_baked(0.5));
    EXPECT_EQ(verdict.grade, Grade::limited);
    EXPECT_EQ(verdict.headline, "Good for pictures, not for metrics.");
    EXPECT_THAT(verdict.not_for, Contains(HasSubstr("uncertain by 25 %")));
    EXPECT_THAT(of_grade(verdict, Grade::bad), AllOf(Contains("force"), Contains("moment"), Contains("k")));
}

TEST(BakeVerdict, IsForSpeedsButNotForSwingsWithoutFalls) {
    Body body = well_baked(0.08);
    body.dynamic.reset();
    const BakeVerdict verdict = judge_bake(body);
    EXPECT_EQ(verdict.headline, "Good for pictures and descent speeds, not for oscillations.");
    EXPECT_THAT(of_grade(verdict, Grade::bad), ElementsAre("rotation"));
    EXPECT_THAT(verdict.not_for, ElementsAre(HasSubstr("frequencies and amplitudes of oscillation")));
}

TEST(BakeVerdict, DoesNotTrustErrorsThatKnowNothingOfTheMesh) {
    Body body = well_baked(0.08);
    std::erase_if(body.tables->error_sources,
                  [](const ErrorShare& share) { return share.source == ErrorSource::mesh; });
    const BakeVerdict verdict = judge_bake(body);
    EXPECT_EQ(verdict.grade, Grade::limited);
    EXPECT_THAT(of_grade(verdict, Grade::bad), ElementsAre("error sources"));
    EXPECT_THAT(verdict.findings, Contains(Field(&Finding::text, HasSubstr("do not include: mesh;"))));
}

TEST(BakeVerdict, IsForNothingOfATrialAndOfAnUnsoundFile) {
    Body trial = well_baked(0.08);
    trial.tables->quality = "smoke";
    EXPECT_EQ(judge_bake(trial).grade, Grade::bad);
    EXPECT_THAT(judge_bake(trial).good_for, IsEmpty());
    Body unsound = well_baked(0.08);
    unsound.kirchhoff->matrix(0, 3) += 1.0;
    const BakeVerdict verdict = judge_bake(unsound);
    EXPECT_EQ(verdict.headline, "Do not use it: the file is invalid.");
    EXPECT_THAT(verdict.good_for, IsEmpty());
}

TEST(BakeVerdict, NotesTheDragCrisis) {
    Body body = well_baked(0.08);
    EXPECT_THAT(of_grade(judge_bake(body), Grade::limited), Not(Contains("drag crisis")));
    body.tables->reynolds_numbers.back() = 2.5e5;
    EXPECT_THAT(of_grade(judge_bake(body), Grade::limited), Contains("drag crisis"));
}

TEST(BakeVerdict, HeedsWhatTheCasesTell) {
    const BakeVerdict verdict = judge_bake(well_baked(0.08), {{Grade::bad, "falls", "differ by half"}});
    EXPECT_EQ(verdict.grade, Grade::limited);
    EXPECT_EQ(verdict.findings.back().what, "falls");
}

TEST(BakeVerdict, NamesAnOpenFoamThatTheCasesAreNotTestedWith) {
    Body body = well_baked(0.08);
    const auto solved_by = [&](const std::string& version) {
        body.tables->provenance = R"([{"name": "a", "direction": [1, 0, 0], "reynolds_number": 1e4,
            "drag_coefficient": 1, "openfoam": ")" +
                                  version + "\"}]";
        return of_grade(judge_bake(body), Grade::limited);
    };
    EXPECT_THAT(solved_by("OPENFOAM=1912 patch=200626"), Not(Contains("solver")));
    EXPECT_THAT(solved_by("10-c4cf895ad8fa"), Contains("solver"));
}

TEST(BakeVerdict, IsNotForSwingsThatSolvedFallsDoNotHave) {
    const BakeVerdict verdict =
        judge_bake(well_baked(0.08), {{Grade::bad, swings_of_falls, "differ by half"}});
    EXPECT_EQ(verdict.headline, "Good for pictures and descent speeds, not for oscillations.");
    EXPECT_THAT(verdict.not_for, ElementsAre(HasSubstr("frequencies and amplitudes of oscillation")));
}

TEST(BakeVerdict, IsNotForSpeedsThatSolvedFallsDoNotHave) {
    const BakeVerdict verdict = judge_bake(well_baked(0.08), {{Grade::bad, "falls", "differ by half"}});
    EXPECT_EQ(verdict.headline, "Good for pictures, not for metrics.");
    EXPECT_THAT(verdict.not_for, ElementsAre(HasSubstr("descent speeds")));
}

TEST(BakeVerdict, SaysForWhichSceneAPartialBakeWasMade) {
    Body body = well_baked(0.08);
    body.tables->plan.subdivisions = 1;
    body.tables->plan.planned = {1, 0, 0, 0, 0, 0, 0, 0, 0};
    const BakeVerdict verdict = judge_bake(body);
    EXPECT_THAT(verdict.not_for, ElementsAre("scenes other than the one it was baked for"));
    EXPECT_THAT(verdict.findings,
                Contains(Field(&Finding::text, HasSubstr("11 % of all directions were solved"))));
}

TEST(PerCent, IsShortAndWithoutExponents) {
    EXPECT_EQ(per_cent(0.0012), "0.12 %");
    EXPECT_EQ(per_cent(0.17), "17 %");
    EXPECT_EQ(per_cent(0.9949), "99 %");
    EXPECT_EQ(per_cent(0.9999), "100 %");
    EXPECT_EQ(per_cent(1.24), "124 %");
    EXPECT_EQ(in_plain_digits(13147.2), "13147");
    EXPECT_EQ(in_plain_digits(0.2345678), "0.2346");
}

TEST(Base64, IsThatOfTheStandardsExamples) {
    // RFC 4648, section 10.
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

/// samara report as it is without the baking tools, on the shipped leaf and on bodies of its own.
class ReportCommand : public testing::Test {
  protected:
    ReportCommand() { std::filesystem::copy_file(shipped / "leaf.body.h5", folder_ / "leaf.body.h5"); }
    [[nodiscard]] int report(const std::vector<const char*>& words, const CasesReader& reader = {}) const {
        std::vector<const char*> argv = {"report"};
        argv.insert(argv.end(), words.begin(), words.end());
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        const int status = run_report(static_cast<int>(argv.size()), argv.data(), reader);
        output_ = testing::internal::GetCapturedStdout();
        error_ = testing::internal::GetCapturedStderr();
        return status;
    }
    [[nodiscard]] std::string in(const char* name) const { return (folder_ / name).string(); }

    test::TemporaryFolder folder_;
    mutable std::string output_;
    mutable std::string error_;
};

TEST_F(ReportCommand, WritesOnePageThatNeedsNothingElse) {
    const std::string page_file = in("leaf.html");
    ASSERT_EQ(report({in("leaf.body.h5").c_str(), "-o", page_file.c_str(), "--json"}), 0) << error_;
    const std::string page = read_bytes(page_file);
    EXPECT_THAT(page, testing::StartsWith("<!DOCTYPE html>"));
    EXPECT_THAT(page, testing::EndsWith("</html>\n"));
    EXPECT_THAT(page, Not(testing::ContainsRegex("<script|src=\"[^d]|href=\"[^#]|@import|url\\(")));
    const std::regex picture("<img src=\"data:image/svg\\+xml;base64,");
    EXPECT_EQ(std::distance(std::sregex_iterator(page.begin(), page.end(), picture), std::sregex_iterator()),
              3);
    EXPECT_LT(page.find("Good for pictures, not for metrics."), page.find("<main>"));
    const nlohmann::json json = nlohmann::json::parse(output_);
    EXPECT_EQ(json["verdict"]["grade"], "limited");
    EXPECT_EQ(json["cases"], nullptr);
    EXPECT_THAT(json["parts"].get<std::vector<std::string>>(),
                ElementsAre("The body", "Polars", "All directions", "Convergence and errors",
                            "Dynamic coefficients", "The cases", "Provenance", "Missing parts"));
}

TEST_F(ReportCommand, SaysWhatItCouldNotReadAndWhy) {
    ASSERT_EQ(report({in("leaf.body.h5").c_str(), "-o", in("leaf.html").c_str()}), 0);
    EXPECT_TRUE(test::is_one_line(error_)) << error_;
    EXPECT_THAT(error_, AllOf(HasSubstr("leaf.cases: is missing"), HasSubstr("give another folder")));
    EXPECT_THAT(read_bytes(in("leaf.html")), HasSubstr("leaf.cases: is missing"));
    std::filesystem::create_directory(folder_ / "leaf.cases");
    static_cast<void>(folder_.file("leaf.cases/plan.json", "{}"));
    ASSERT_EQ(report({in("leaf.body.h5").c_str(), "-o", in("leaf.html").c_str()}), 0);
    EXPECT_THAT(error_, HasSubstr("needs the baking tools"));
}

TEST_F(ReportCommand, PutsWhatTheCasesTellIntoThePageAndTheVerdict) {
    std::filesystem::create_directory(folder_ / "leaf.cases");
    static_cast<void>(folder_.file("leaf.cases/plan.json", "{}"));
    const CasesReader reader = [](const auto&, const auto&, const auto&) {
        return CasesReport{{{"Told by the cases", {text_block("told <b>")}}},
                           {{Grade::limited, "y+", "too small"}},
                           {"no falls"}};
    };
    ASSERT_EQ(report({in("leaf.body.h5").c_str(), "-o", in("leaf.html").c_str(), "--json"}, reader), 0)
        << error_;
    const nlohmann::json json = nlohmann::json::parse(output_);
    EXPECT_EQ(json["verdict"]["findings"].back()["what"], "y+");
    EXPECT_THAT(json["parts"].get<std::vector<std::string>>(), Contains("Told by the cases"));
    EXPECT_EQ(json["missing"], nlohmann::json::array({"no falls"}));
    EXPECT_THAT(read_bytes(in("leaf.html")), HasSubstr("<p>told &lt;b&gt;</p>"));
}

TEST_F(ReportCommand, ShowsANameAsTextWhateverItHolds) {
    Body body = read_body_file(shipped / "leaf.body.h5");
    body.name = "<script>alert(1)</script>";
    write_body_file(folder_ / "odd.body.h5", body);
    ASSERT_EQ(report({in("odd.body.h5").c_str(), "-o", in("odd.html").c_str()}), 0) << error_;
    EXPECT_THAT(read_bytes(in("odd.html")),
                AllOf(Not(HasSubstr("<script")), HasSubstr("&lt;script&gt;alert(1)")));
}

TEST_F(ReportCommand, StillTellsTheVerdictWhereThePageCannotBeMade) {
    ::setenv("SAMARA_PYTHON", "/bin/false", 1);
    const int status = report({in("leaf.body.h5").c_str(), "-o", in("leaf.html").c_str()});
    ::unsetenv("SAMARA_PYTHON");
    EXPECT_EQ(status, 1);
    EXPECT_THAT(output_, HasSubstr("Good for pictures, not for metrics."));
    EXPECT_THAT(error_, HasSubstr("/bin/false failed to make the page"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "leaf.html"));
}

TEST_F(ReportCommand, RefusesWhatIsNoBakeInOneLineAndWritesNothing) {
    write_body_file(folder_ / "bare.body.h5", test::rubber_ellipsoid());
    const auto rejected = [&](const std::vector<const char*>& words, const char* text) {
        EXPECT_EQ(report(words), 1);
        EXPECT_TRUE(test::is_one_line(error_)) << error_;
        EXPECT_THAT(error_, HasSubstr(text));
        EXPECT_FALSE(std::filesystem::exists(folder_ / "no.html"));
    };
    const std::string leaf = in("leaf.body.h5");
    const std::string bare = in("bare.body.h5");
    const std::string page = in("no.html");
    const std::string none = in("none.cases");
    rejected({bare.c_str(), "-o", page.c_str()}, "has no tables to judge");
    rejected({leaf.c_str(), "-o", in("no.pdf").c_str()}, "name it NAME.html");
    rejected({leaf.c_str(), "-o", page.c_str(), "--cases", none.c_str()},
             "is not a folder of cases (it has no plan.json");
    rejected({none.c_str(), "-o", page.c_str()}, "none.cases");
}

}  // namespace
}  // namespace samara
