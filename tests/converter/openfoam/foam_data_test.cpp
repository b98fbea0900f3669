#include <cstdint>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "converter/openfoam/foam_file.hpp"
#include "paths.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

std::string header(const std::string& format, const std::string& class_name) {
    return "/*---*\\\n| = |\n\\*---*/\nFoamFile\n{\n    version 2.0;\n    format " + format +
           ";\n    class " + class_name +
           ";\n    arch \"LSB;label=32;scalar=64\";\n    location \"100\";\n    object U;\n}\n// * * //\n";
}

class FoamData : public testing::Test {
  protected:
    std::string error(const std::string& text) {
        return test::error_of([&] { require_foam_data(folder_.file("U", text)); });
    }
    void expect_data(const std::string& text) { EXPECT_NO_THROW(require_foam_data(folder_.file("U", text))); }
    /// Returns the error of a field with this text in its boundaryField.
    std::string error_of_patch(const std::string& entry) {
        return error(header("ascii", "volVectorField") + "boundaryField\n{\n    far\n    {\n" + entry +
                     "\n    }\n}\n");
    }

    test::TemporaryFolder folder_;
};

TEST_F(FoamData, TakesWhatOpenFoamWrites) {
    for (const char* name : {"V", "cellZones", "kMean"}) {
        EXPECT_NO_THROW(require_foam_data(std::filesystem::path(SAMARA_SOURCE_DIRECTORY) /
                                          "tests/converter/openfoam-v1912" / name));
    }
    expect_data(header("ascii", "dictionary") +
                "value 12;\nname \"12\";\nresults { shell { volAverage(shell,k) 4e-4; } }\n");
    expect_data(header("ascii", "volVectorField") +
                "dimensions [0 1 -1 0 0 0 0];\ninternalField uniform (1 0 0);\nboundaryField { far { type "
                "freestreamVelocity; freestreamValue uniform (-1 0 0); } }\n");
}

TEST_F(FoamData, PassesOverTheBytesOfNumbersWhateverTheySpell) {
    std::string bytes(48, '#');
    std::memcpy(bytes.data() + 4, "#calc \"$x\"; } libs", 18);
    expect_data(header("binary", "volVectorField") + "internalField nonuniform List<vector> \n2\n(" + bytes +
                ");\n");
    expect_data(header("binary", "vectorField") + "2\n(" + bytes + ")\n");
    expect_data(header("binary", "volScalarField") +
                "boundaryField { body { value nonuniform List<scalar> 6(" + bytes +
                "); } far { value nonuniform List<scalar> 0(); } }\n");
}

TEST_F(FoamData, LetsAFileBeThatEndsEarly) {
    expect_data("");
    expect_data(header("binary", "volVectorField") + "internalField nonuniform List<vector> \n9\n(abc");
}

TEST_F(FoamData, RejectsWhatOpenFoamWouldRunOrRead) {
    EXPECT_THAT(error_of_patch("value #calc \"1\";"),
                EndsWith("U:18: holds '#calc', which is not allowed there"));
    EXPECT_THAT(error_of_patch("#include \"/etc/passwd\""), HasSubstr("holds '#include'"));
    EXPECT_THAT(error_of_patch("value $other;"), HasSubstr("holds '$other'"));
    EXPECT_THAT(error_of_patch("type codedFixedValue;"), HasSubstr("holds 'codedFixedValue'"));
    EXPECT_THAT(error_of_patch("libs (\"strange.so\");"), HasSubstr("holds 'libs'"));
    EXPECT_THAT(error_of_patch("\"li.*\" (\"strange.so\");"), HasSubstr("holds a name in quotes"));
    EXPECT_THAT(error_of_patch("code #{ system(\"x\"); #};"), HasSubstr("holds 'code'"));
}

TEST_F(FoamData, RejectsBytesThatAreHiddenInABlockOfAnotherForm) {
    EXPECT_THAT(error(header("binary", "volVectorField") + "internalField nonuniform List<word> 2(#calc);"),
                HasSubstr("holds a binary 'List<word>'"));
    EXPECT_THAT(error(header("binary", "volScalarField") +
                      "internalField nonuniform List<scalar> 1(12345678#calc \"1\""),
                HasSubstr("a binary list that does not end"));
    EXPECT_THAT(error("FoamFile { format binary; format ascii; class volScalarField; }"),
                HasSubstr("a header with the entry 'format'"));
    EXPECT_THAT(error("FoamFile { format binary; #calc \"1\" }"), HasSubstr("a header with the entry ''"));
    EXPECT_THAT(error("value #calc \"1\";"), HasSubstr("does not begin with FoamFile {"));
}

}  // namespace
}  // namespace samara
