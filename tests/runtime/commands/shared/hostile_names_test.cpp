// Names that are commands to a terminal, a spreadsheet, a browser or a typesetter of formulas, and names that
// are no UTF-8.

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/export/chan_file.hpp"
#include "samara/export/csv_file.hpp"
#include "samara/export/gltf_file.hpp"
#include "samara/export/page_file.hpp"
#include "samara/export/usd_file.hpp"
#include "samara/pictures/draw.hpp"
#include "samara/pictures/motion_pictures.hpp"
#include "support/known_bodies.hpp"
#include "support/program_run.hpp"
#include "support/temporary_folder.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* hostile = "\x1b]0;owned\x07\xff\xe2\x80\xae</script>'\"`touch pwned`";

Motion motion_named(const std::string& name) {
    Motion motion = test::motion_of(test::wander, 0.5);
    motion.bodies[0].name = name;
    return motion;
}

testing::Matcher<const std::string&> is_harmless() {
    return AllOf(Not(HasSubstr("\x1b")), Not(HasSubstr("\x07")), Not(HasSubstr("\xff")),
                 Not(HasSubstr("\xe2\x80\xae")));
}

TEST(HostileNames, OfBodiesAreShownByInfoAndObeyedByNoTerminal) {
    const test::TemporaryFolder folder;
    Body body = test::rubber_ellipsoid();
    body.name = hostile;
    body.source = "from \x1b[2J";
    write_body_file(folder / "stone.body.h5", body);
    const test::ProgramRun text = test::run_program_in(folder, {"samara", "info", "stone.body.h5"});
    EXPECT_EQ(text.status, 0) << text.error;
    EXPECT_THAT(text.output, AllOf(is_harmless(), HasSubstr(R"(\x1b]0;owned\x07\xff\xe2\x80\xae</script>)")));
    const test::ProgramRun json = test::run_program_in(folder, {"samara", "info", "stone.body.h5", "--json"});
    EXPECT_EQ(json.status, 0) << json.error;
    EXPECT_THAT(json.output, is_harmless());
    EXPECT_THAT(json.json()["name"].get<std::string>(), HasSubstr("owned"));
}

TEST(HostileNames, OfFilesAreShownInRefusals) {
    const test::TemporaryFolder folder;
    const std::string name = "\x1b[2J\xff.h5";
    for (const std::vector<std::string>& words : {std::vector<std::string>{"info", name},
                                                  {"kirchhoff", name},
                                                  {"compare", name, name},
                                                  {"simulate", name, "-o", "out.h5"},
                                                  {"export", name, "-o", "out.csv"},
                                                  {"plot", name, "-o", "out.png"},
                                                  {"export", "none.h5", "-o", name}}) {
        std::vector<std::string> all = {"samara"};
        all.insert(all.end(), words.begin(), words.end());
        const test::ProgramRun run = test::run_program_in(folder, all);
        EXPECT_EQ(run.status, 1) << words[0];
        EXPECT_TRUE(test::is_one_line(run.error)) << run.error;
        EXPECT_THAT(run.error, AllOf(is_harmless(), HasSubstr(R"(\x1b[2J\xff.h5)"))) << words[0];
    }
}

TEST(HostileNames, OfFilesThatAreNoUtf8AreWrittenAndReported) {
    const test::TemporaryFolder folder;
    write_body_file(folder / "rubber.body.h5", test::rubber_ellipsoid());
    (void)folder.file("scene.toml",
                      "[scene]\nduration = 0.1\n[[body]]\nname = \"rubber\"\nshape = \"rubber.body.h5\"\n"
                      "density = 1200\nloads = \"none\"\n");
    const test::ProgramRun run =
        test::run_program_in(folder, {"samara", "simulate", "scene.toml", "-o", "caf\xe9.h5", "--json"});
    EXPECT_EQ(run.status, 0) << run.error;
    EXPECT_TRUE(std::filesystem::exists(folder / "caf\xe9.h5"));
    EXPECT_EQ(run.json()["output"], "caf\xef\xbf\xbd.h5");
    const test::ProgramRun exported =
        test::run_program_in(folder, {"samara", "export", "caf\xe9.h5", "-o", "\xff.csv", "--json"});
    EXPECT_EQ(exported.status, 0) << exported.error;
    EXPECT_TRUE(std::filesystem::exists(folder / "\xff.csv"));
}

TEST(HostileNames, AreNoFormulasInTables) {
    const test::TemporaryFolder folder;
    const auto second_line = [&](const std::string& name) {
        write_csv(folder / "motion.csv", motion_named(name));
        const std::string table = read_bytes(folder / "motion.csv");
        const std::size_t begin = table.find('\n') + 1;
        return table.substr(begin, table.find('\n', begin) - begin);
    };
    EXPECT_THAT(second_line("=cmd"), HasSubstr("0,'=cmd,0,"));
    EXPECT_THAT(second_line("+1"), HasSubstr("0,'+1,0,"));
    EXPECT_THAT(second_line("-1"), HasSubstr("0,'-1,0,"));
    EXPECT_THAT(second_line("@sum(a1,\"x\")"), HasSubstr("0,\"'@sum(a1,\"\"x\"\")\",0,"));
    EXPECT_THAT(second_line("\t=cmd\r\n"), HasSubstr(R"(0,\x09=cmd\x0d\x0a,0,)"));
    EXPECT_THAT(second_line("leaf-1=2"), HasSubstr("0,leaf-1=2,0,")) << "others stay";
}

TEST(HostileNames, ReachNoAnimationToolAsTheyAre) {
    const test::TemporaryFolder folder;
    Motion motion = motion_named(hostile);
    write_glb(folder / "motion.glb", motion);
    EXPECT_THAT(read_bytes(folder / "motion.glb"),
                HasSubstr(R"(\\x1b]0;owned\\x07\\xff\\xe2\\x80\\xae</script>)"));
    write_usda(folder / "motion.usda", motion);
    EXPECT_THAT(read_bytes(folder / "motion.usda"), is_harmless());
    motion.bodies.push_back(motion.bodies[0]);
    motion.bodies[1].name = "../../other\x1b";
    for (const auto& file : write_chan(folder / "motion.chan", motion)) {
        EXPECT_EQ(file.parent_path(), folder.path());
        EXPECT_THAT(file.filename().string(), is_harmless());
    }
}

TEST(HostileNames, OpenAndEndNoElementOfThePage) {
    ASSERT_TRUE(has_page()) << "configure with -DSAMARA_PAGE=ON";
    const test::TemporaryFolder folder;
    write_page(folder / "motion.html", motion_named("<!--<script>\xe2\x80\xa8\xff"), 0, "<!--<script>",
               "</script>");
    const std::string page = read_bytes(folder / "motion.html");
    const std::size_t begin = page.find("id=\"motion-header\">");
    const std::string header = page.substr(begin + 19, page.find("</script>", begin) - begin - 19);
    EXPECT_THAT(header, Not(HasSubstr("<")));
    const auto json = nlohmann::json::parse(header);
    EXPECT_EQ(json["bodies"][0]["name"], "<!--<script>\xe2\x80\xa8\xef\xbf\xbd");
    EXPECT_EQ(json["title"], "<!--<script>");
}

TEST(HostileNames, AreTextInPictures) {
    const test::TemporaryFolder folder;
    for (const char* name :
         {hostile, "a'; $x^2$ \\frac{1}{0} '{/Times=99 x}", "a\n{{ 1 + 1 }} @x_1^2 & <b>\\"}) {
        const Motion motion = motion_named(name);
        draw_picture(folder / "motion.svg", motion_picture("strip", motion, motion.bodies[0], 0, 0));
        EXPECT_FALSE(std::filesystem::exists(folder / "pwned")) << name;
        const std::string picture = read_bytes(folder / "motion.svg");
        EXPECT_THAT(picture, AllOf(is_harmless(), Not(HasSubstr("<b>")), Not(HasSubstr("</script>'"))));
        if (name == hostile) continue;
        EXPECT_THAT(picture,
                    AnyOf(HasSubstr("$x^2$ \\frac"), HasSubstr("{{ 1 + 1 }} @x_1^2 &amp; &lt;b&gt;")));
    }
}

}  // namespace
}  // namespace samara
