#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshes/reading/shape_reader.hpp"
#include "paths.hpp"
#include "samara/core/files/content_hash.hpp"
#include "support/expect_error.hpp"

namespace samara {
namespace {

using ::testing::StartsWith;

std::string error_of(const std::string& script) {
    return test::error_of([&] { require_shape_script(script, "a.geo"); });
}

TEST(ScriptCheck, NamesTheLineAndTheStatementThatIsRejected) {
    EXPECT_EQ(
        error_of("r = 1;\n// a sphere\nSystemCall \"touch x\";\n"),
        "a.geo: line 3: SystemCall starts a program, which is not allowed in a shape; delete the statement");
    EXPECT_THAT(error_of("System 'ls';"), StartsWith("a.geo: line 1: System starts a program"));
    EXPECT_THAT(error_of("NonBlockingSystemCall Sprintf(\"ls\");"), StartsWith("a.geo: line 1: NonBlock"));
    EXPECT_THAT(error_of("\n\nOnelabRun(\"c\", \"ls\");"), StartsWith("a.geo: line 3: OnelabRun starts"));
    EXPECT_THAT(error_of("Field[1] = ExternalProcess;"), StartsWith("a.geo: line 1: ExternalProcess starts"));
    EXPECT_THAT(error_of("Save \"a.msh\";"), StartsWith("a.geo: line 1: Save writes a file"));
    EXPECT_THAT(error_of("Save View[0] \"a.pos\";"), StartsWith("a.geo: line 1: Save writes a file"));
    EXPECT_THAT(error_of("Print name;"), StartsWith("a.geo: line 1: Print writes a file"));
    EXPECT_THAT(error_of("CreateDir StrCat(\"a\", \"b\");"), StartsWith("a.geo: line 1: CreateDir writes"));
    EXPECT_THAT(error_of("Printf(\"x\") > \"a\";"), StartsWith("a.geo: line 1: Printf writes a file"));
    EXPECT_THAT(error_of("/* two\nlines */ Printf(\"%g\", f(1)) >> \"a\";"),
                StartsWith("a.geo: line 2: Printf"));
    EXPECT_THAT(error_of("If(1)\n Exit;\nEndIf"), StartsWith("a.geo: line 2: Exit ends gmsh"));
}

TEST(ScriptCheck, SeesThroughBlanksAndComments) {
    EXPECT_THAT(error_of("SystemCall/* */\n\"ls\";"), StartsWith("a.geo: line 1: SystemCall"));
    EXPECT_THAT(error_of("If(1)SystemCall\"ls\";EndIf"), StartsWith("a.geo: line 1: SystemCall"));
    EXPECT_THAT(error_of("a = \"//\"; SystemCall \"ls\";"), StartsWith("a.geo: line 1: SystemCall"));
    EXPECT_THAT(error_of("a = '\"'; SystemCall \"ls\";"), StartsWith("a.geo: line 1: SystemCall"));
    EXPECT_THAT(error_of("Printf(\"%g\", (1)) /* */ > \"a\";"), StartsWith("a.geo: line 1: Printf"));
}

TEST(ScriptCheck, TakesWhatShapesAreMadeOf) {
    for (const char* script :
         {"", "// SystemCall \"ls\";", "/* Exit; */", "/* never closed Exit;", "Printf(\"Exit; > 'a'\");",
          "a = \"Save", "Printf(\"%g\", a > b);", "Printf(\"x\"); If (a > b) c = 1; EndIf",
          "Save = 1; b = Save + Print;", "For Save In {1:3}\nPoint(Save) = {0, 0, 0}; EndFor",
          "Macro Print\nPoint(1) = {0, 0, 0};\nReturn\nCall Print;", "Print.Background = 1;",
          "Include \"sizes.geo\"; Merge \"part.step\";", "Sleep 1; Mesh 2; Abort;"}) {
        EXPECT_NO_THROW(require_shape_script(script, "a.geo")) << script;
    }
}

TEST(ScriptCheck, TakesTheShapesThatComeWithSamara) {
    int count = 0;
    for (const char* folder : {"meshes/shapes", "docs/studies/falls"}) {
        for (const auto& entry :
             std::filesystem::directory_iterator(std::filesystem::path(SAMARA_SOURCE_DIRECTORY) / folder)) {
            if (entry.path().extension() != ".geo") continue;
            EXPECT_NO_THROW(require_shape_script(read_bytes(entry.path()), entry.path().string()));
            ++count;
        }
    }
    EXPECT_GE(count, 11);
}

}  // namespace
}  // namespace samara
