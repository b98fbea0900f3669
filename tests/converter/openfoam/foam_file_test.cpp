#include "converter/openfoam/foam_file.hpp"

#include <chrono>
#include <cstring>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gzip.hpp"
#include "samara/core/base/error.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

std::string header(const std::string& class_name, const std::string& format = "ascii",
                   const std::string& more = "") {
    return fmt::format(
        "/*---- C++ ----*\\\n| banner |\n\\*----*/\nFoamFile\n{{\n    version     2.0;\n    format      "
        "{};\n{}"
        "    class       {};\n    location    \"200\";\n    object      kMean;\n}}\n// * * * //\n\n",
        format, more, class_name);
}

template <typename Number>
std::string raw(const std::vector<Number>& numbers) {
    std::string bytes(numbers.size() * sizeof(Number), '\0');
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    return bytes;
}

class FoamFile : public testing::Test {
  protected:
    std::filesystem::path scalar(const std::string& body) {
        return folder_.file("kMean", header("volScalarField") + "dimensions [0 2 -2 0 0 0 0];\n\n" + body);
    }
    std::string error_in(const std::string& body) {
        const std::filesystem::path file = scalar(body);
        std::string message = test::error_of([&] { read_scalar_field(file); });
        EXPECT_EQ(message.find(file.string() + ":"), 0U) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos);
        return message;
    }

    test::TemporaryFolder folder_;
};

TEST_F(FoamFile, ListsOneValueToALine) {
    const auto field = read_scalar_field(scalar(
        "internalField   nonuniform List<scalar> \n3\n(\n1.5\n-2e-05\n3\n)\n;\n\nboundaryField\n{\n}\n"));
    EXPECT_FALSE(field.uniform);
    EXPECT_THAT(field.values, ElementsAre(1.5, -2e-5, 3.0));
    EXPECT_TRUE(field.covers(2));
    EXPECT_FALSE(field.covers(3));
}

TEST_F(FoamFile, ShortListsOnOneLineAndCommentsBetween) {
    const auto field =
        read_scalar_field(scalar("#include \"../parameters\"\nsub { a (1 2); b { c 3; } }\n"
                                 "internalField nonuniform List<scalar> 3(1 2 3); // end\n"));
    EXPECT_THAT(field.values, ElementsAre(1.0, 2.0, 3.0));
}

TEST_F(FoamFile, EqualValuesWrittenOnce) {
    EXPECT_THAT(read_scalar_field(scalar("internalField nonuniform List<scalar> 4{0.25};")).values,
                ElementsAre(0.25, 0.25, 0.25, 0.25));
}

TEST_F(FoamFile, UniformFieldsCoverEveryCell) {
    const auto field = read_scalar_field(scalar("internalField   uniform 0.0015;\n"));
    EXPECT_TRUE(field.uniform);
    EXPECT_TRUE(field.covers(1000000));
    EXPECT_EQ(field[123], 0.0015);
}

TEST_F(FoamFile, FieldsOverTheCellsAlone) {
    const auto file =
        folder_.file("V", header("volScalarField::Internal") +
                              "dimensions [0 3 0 0 0 0 0];\n\nvalue nonuniform List<scalar> 2(1 2);\n");
    EXPECT_THAT(read_scalar_field(file).values, ElementsAre(1.0, 2.0));
}

TEST_F(FoamFile, ValuesThatAreNoNumbersInTheSolverAreReadAsSuch) {
    const auto field = read_scalar_field(scalar("internalField nonuniform List<scalar> 2(nan -inf);"));
    EXPECT_TRUE(std::isnan(field.values[0]));
    EXPECT_TRUE(std::isinf(field.values[1]));
}

TEST_F(FoamFile, Vectors) {
    const auto file = folder_.file("UMean", header("volVectorField") +
                                                "dimensions [0 1 -1 0 0 0 0];\ninternalField nonuniform "
                                                "List<vector> \n2\n(\n(1 2 3)\n(-4 5e-1 6)\n)\n;\n");
    const auto field = read_vector_field(file);
    ASSERT_EQ(field.values.size(), 2U);
    EXPECT_EQ(field[1], Vector3d(-4.0, 0.5, 6.0));
    EXPECT_THAT(test::error_of([&] { read_scalar_field(file); }),
                HasSubstr("holds a volVectorField, not a volScalarField"));
}

TEST_F(FoamFile, BinaryScalarsVectorsAndLabels) {
    const std::string arch = "    arch        \"LSB;label=32;scalar=64\";\n";
    // The value 4.0 holds bytes that look like brackets and comments nowhere, so a few that do stand beside
    // it.
    double tricky = 0.0;
    std::memcpy(&tricky, "//(;)}/*", sizeof tricky);
    const auto k = folder_.file("k", header("volScalarField", "binary", arch) +
                                         "internalField nonuniform List<scalar> \n3\n(" +
                                         raw<double>({4.0, tricky, -1.0}) + ")\n;\n");
    EXPECT_THAT(read_scalar_field(k).values, ElementsAre(4.0, tricky, -1.0));
    const auto u = folder_.file("U", header("volVectorField", "binary", arch) +
                                         "internalField nonuniform List<vector> \n1\n(" +
                                         raw<double>({1.0, 2.0, 3.0}) + ")\n;\n");
    EXPECT_EQ(read_vector_field(u).values.at(0), Vector3d(1, 2, 3));
    const auto zones =
        folder_.file("cellZones", header("regIOobject", "binary", arch) +
                                      "1\n(\nshell\n{\n    type cellZone;\ncellLabels List<label> \n2\n(" +
                                      raw<std::int32_t>({7, 41}) + ");\n}\n)\n");
    EXPECT_THAT(read_cell_zone(zones, "shell"), ElementsAre(7, 41));
}

TEST_F(FoamFile, BinaryOfOtherWidths) {
    const std::string arch = "    arch        \"LSB;label=64;scalar=32\";\n";
    const auto k = folder_.file("k", header("volScalarField", "binary", arch) +
                                         "internalField nonuniform List<scalar> \n2\n(" +
                                         raw<float>({0.5F, 2.0F}) + ")\n;\n");
    EXPECT_THAT(read_scalar_field(k).values, ElementsAre(0.5, 2.0));
    const auto zones =
        folder_.file("cellZones", header("regIOobject", "binary", arch) +
                                      "1\n(\nshell\n{\n type cellZone;\ncellLabels List<label> \n1\n(" +
                                      raw<std::int64_t>({1LL << 40}) + ");\n}\n)\n");
    EXPECT_THAT(read_cell_zone(zones, "shell"), ElementsAre(1LL << 40));
}

TEST_F(FoamFile, OtherMachinesBinaryIsRejected) {
    const std::string arch = "    arch \"MSB;label=32;scalar=64\";\n";
    const auto k = folder_.file("k", header("volScalarField", "binary", arch));
    EXPECT_THAT(test::error_of([&] { read_scalar_field(k); }),
                HasSubstr("k:12: is binary with another byte order; set 'writeFormat ascii' in "
                          "system/controlDict there and run foamFormatConvert"));
    const auto text =
        folder_.file("k", header("volScalarField", "ascii", arch) + "internalField uniform 3;\n");
    EXPECT_EQ(read_scalar_field(text)[0], 3.0);
}

TEST_F(FoamFile, CompressedFilesAreReadAsTheyStand) {
    const std::string text = header("volScalarField") + "internalField uniform 3;\n";
    static_cast<void>(folder_.file("k.gz", test::gzipped(text)));
    EXPECT_EQ(read_scalar_field(folder_.path() / "k")[0], 3.0);
    static_cast<void>(folder_.file("k.gz", test::gzipped(text + "internalField")));
    static_cast<void>(
        folder_.file("epsilon.gz", test::gzipped(header("volScalarField") + "internalField x;")));
    EXPECT_THAT(test::error_of([&] { read_scalar_field(folder_.path() / "epsilon"); }),
                HasSubstr("epsilon.gz:14: expected 'uniform' or 'nonuniform', found 'x'"));
}

TEST_F(FoamFile, HeadersOfManyVersionsAreUnderstood) {
    const auto read = [&](const std::string& head, const std::string& body) {
        return read_scalar_field(folder_.file("k", head + body)).values;
    };
    const std::string text = "dimensions [0 2 -2 0 0 0 0];\ninternalField nonuniform List<scalar> 2(1 2);\n";
    // v2106: the architecture in text files, too; v2212: a dictionary of other things; 9: no version, no
    // location; 10: no format.
    for (const char* const head :
         {"FoamFile\n{\n    version 2.0;\n    format ascii;\n    arch \"LSB;label=32;scalar=64\";\n    class "
          "volScalarField;\n    location \"200\";\n    object k;\n}\n",
          "FoamFile\n{\n    version 2;\n    format ascii;\n    class volScalarField;\n    meta { a (1 2); b "
          "{ c "
          "\"}\"; } }\n    object k;\n}\n",
          "FoamFile\n{\n    format ascii;\n    class volScalarField;\n    note \"nCells: 2; of {some} "
          "(kind\";\n "
          "   object k;\n}\n",
          "FoamFile { class volScalarField; location \"200\"; object k; }\n"}) {
        EXPECT_THAT(read(head, text), ElementsAre(1.0, 2.0)) << head;
    }
    const std::string binary = "internalField nonuniform List<scalar> 2(" + raw<double>({1.0, 2.0}) + ");\n";
    EXPECT_THAT(read("FoamFile { version 2.0; format binary; class volScalarField; object k; }\n", binary),
                ElementsAre(1.0, 2.0));
}

TEST_F(FoamFile, FacesOfBothTypes) {
    const auto expect_two = [&](const std::filesystem::path& file) {
        const FoamFaces faces = read_faces(file);
        EXPECT_EQ(faces.size(), 2U);
        EXPECT_THAT(faces.starts, ElementsAre(0, 4, 7));
        EXPECT_THAT(faces.points, ElementsAre(0, 1, 2, 3, 7, 5, 6));
    };
    expect_two(folder_.file("faces", header("faceList") + "\n2\n(\n4(0 1 2 3)\n3(7 5 6)\n)\n"));
    expect_two(
        folder_.file("faces", header("faceCompactList") + "3(0 4 7)\n\n7\n(\n0\n1\n2\n3\n7\n5\n6\n)\n"));
    expect_two(folder_.file("faces", header("faceCompactList", "binary") + "\n3\n(" +
                                         raw<std::int32_t>({0, 4, 7}) + ")\n\n7\n(" +
                                         raw<std::int32_t>({0, 1, 2, 3, 7, 5, 6}) + ")\n"));
    const auto error = [&](const std::string& text) {
        const auto file = folder_.file("faces", text);
        return test::error_of([&] { read_faces(file); });
    };
    EXPECT_THAT(error(header("faceCompactList") + "3(0 4 9)\n3(0 1 2)\n"),
                HasSubstr("its faces do not fit their points"));
    EXPECT_THAT(error(header("labelList") + "0()\n"), HasSubstr("holds a labelList, not a faceList"));
}

TEST_F(FoamFile, LabelsAndPoints) {
    EXPECT_THAT(read_labels(folder_.file("owner", header("labelList") + "3(0 0 5)\n")), ElementsAre(0, 0, 5));
    EXPECT_THAT(read_points(folder_.file("points", header("vectorField") + "1((1 2 3))\n")),
                ElementsAre(Vector3d(1, 2, 3)));
    const auto other = folder_.file("points", header("labelList") + "1(0)\n");
    EXPECT_THAT(test::error_of([&] { read_points(other); }),
                HasSubstr("holds a labelList, not a vectorField"));
    const auto field = folder_.file("owner", header("volScalarField") + "internalField uniform 1;\n");
    EXPECT_THAT(test::error_of([&] { read_labels(field); }),
                HasSubstr("holds a volScalarField, not a labelList"));
    EXPECT_THAT(test::error_of([&] { read_cell_zone(field, "shell"); }),
                HasSubstr("holds a volScalarField, not cell zones"));
}

TEST_F(FoamFile, ErrorsNameFileAndLine) {
    EXPECT_THAT(error_in("internalField nonuniform List<scalar> \n3\n(\n1\n2\n)\n;"),
                EndsWith(":21: the list should have 3 values, but ends after 2"));
    EXPECT_THAT(error_in("internalField nonuniform List<scalar> \n1\n(\n1\n2\n)\n;"),
                EndsWith(":20: the list should have 1 values, but continues"));
    EXPECT_THAT(error_in("internalField nonuniform List<scalar> 2\n(\n1\nabc\n)\n;"),
                EndsWith(":19: expected a number, found 'abc'"));
    EXPECT_THAT(error_in("internalField nonuniform List<scalar> 2\n(\n1\n1.5.2\n)\n;"),
                EndsWith(":19: expected a number, found '1.5.2'"));
    EXPECT_THAT(error_in("internalField nonuniform List<scalar> 2\n(\n1\n"),
                HasSubstr("expected a number, found the end of the file"));
    EXPECT_THAT(error_in("internalField nonuniform List<scalar> -2();"), HasSubstr("cannot have -2 values"));
    EXPECT_THAT(error_in("internalField nonuniform List<scalar> 900000000{1};"),
                HasSubstr("may have 32000000 values, not 900000000"));
    EXPECT_THAT(error_in("internalField sometimes 3;"), HasSubstr("found 'sometimes'"));
    EXPECT_THAT(error_in("internalField uniform 3"), HasSubstr("expected ';', found the end of the file"));
    EXPECT_THAT(error_in("boundaryField { far { type patch; } }"), HasSubstr("has no internalField"));
    EXPECT_THAT(error_in("boundaryField { far { type patch; }"), HasSubstr("does not end with '}'"));
    EXPECT_THAT(error_in("/* endless"), HasSubstr(":16: this comment has no end"));
}

TEST_F(FoamFile, FilesOfAnotherTypeAreRejected) {
    const auto empty = folder_.file("empty", "");
    const auto text = folder_.file("text", "hello world");
    const auto garbage = folder_.file("garbage", std::string("\x89HDF\r\n\x1a\n\0\0", 10));
    for (const auto& file : {empty, text, garbage}) {
        EXPECT_THAT(test::error_of([&] { read_scalar_field(file); }), HasSubstr("not an OpenFOAM file"));
    }
    EXPECT_THAT(test::error_of([&] { read_scalar_field(folder_.path() / "none"); }),
                HasSubstr("does not exist"));
}

TEST_F(FoamFile, BinaryThatIsCutShortIsRejected) {
    const auto k =
        folder_.file("k", header("volScalarField", "binary", "    arch \"LSB;label=32;scalar=64\";\n") +
                              "internalField nonuniform List<scalar> \n3\n(" + raw<double>({4.0}));
    EXPECT_THAT(test::error_of([&] { read_scalar_field(k); }), HasSubstr("the file ends 16 bytes too early"));
}

TEST_F(FoamFile, IsRejectedWhereverItIsCutShort) {
    const std::string ascii = header("volScalarField") +
                              "dimensions [0 2 -2 0 0 0 0];\ninternalField nonuniform List<scalar> 2(0.5 4);";
    const std::string binary = header("volScalarField", "binary", "    arch \"LSB;label=32;scalar=64\";\n") +
                               "internalField nonuniform List<scalar> 2(" + raw<double>({4.0, 5.0}) + ");";
    for (const std::string& whole : {ascii, binary}) {
        EXPECT_EQ(read_scalar_field(folder_.file("k", whole)).values.size(), 2U);
        for (std::size_t length = 0; length < whole.size(); ++length) {
            const std::filesystem::path file = folder_.file("k", whole.substr(0, length));
            EXPECT_THROW(read_scalar_field(file), Error) << "after " << length << " bytes";
        }
    }
}

TEST_F(FoamFile, ZonesAreFoundByName) {
    const auto file =
        folder_.file("cellZones", header("regIOobject") +
                                      "2\n(\nwake\n{\n    type cellZone;\ncellLabels      List<label> \n"
                                      "3\n(\n5\n6\n7\n)\n;\n}\n\nshell\n{\n    type cellZone;\n"
                                      "cellLabels      List<label> 2(1 9);\n}\n)\n");
    EXPECT_THAT(read_cell_zone(file, "shell"), ElementsAre(1, 9));
    EXPECT_THAT(read_cell_zone(file, "wake"), ElementsAre(5, 6, 7));
    EXPECT_THAT(test::error_of([&] { read_cell_zone(file, "hull"); }),
                HasSubstr("has no cell zone 'hull' (it has: wake, shell); make it with topoSet"));
    EXPECT_THAT(test::error_of(
                    [&] { read_cell_zone(folder_.file("none", header("regIOobject") + "0()\n"), "shell"); }),
                HasSubstr("has no cell zone 'shell'"));
}

TEST_F(FoamFile, AMillionCellsAreReadInUnderTwoSeconds) {
    std::string body = "internalField nonuniform List<scalar> \n1000000\n(\n";
    for (int i = 0; i < 1000000; ++i) body += fmt::format("{:.8g}\n", 1.0 / (3.0 + i));
    const std::filesystem::path file = scalar(body + ")\n;\n");
    const auto start = std::chrono::steady_clock::now();
    const auto field = read_scalar_field(file);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(field.values.size(), 1000000U);
    EXPECT_LT(elapsed.count(), 2.0);
    RecordProperty("seconds", fmt::format("{:.3f}", elapsed.count()));
}

}  // namespace
}  // namespace samara
