#include "meshes/reading/shape_reader.hpp"

#include <bit>
#include <cstring>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/core/base/text.hpp"
#include "samara/core/surface/mended_surface.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// A box of 1 x 2 x 3 with a corner at (5, 0, 0).
constexpr int corners[8][3] = {{5, 0, 0}, {6, 0, 0}, {6, 2, 0}, {5, 2, 0},
                               {5, 0, 3}, {6, 0, 3}, {6, 2, 3}, {5, 2, 3}};
constexpr int sides[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                             {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

std::string lines(const char* before, const char* behind) {
    std::string text = before;
    for (const auto& corner : corners)
        text += fmt::format("{} {} {}{}\n", corner[0], corner[1], corner[2], behind);
    return text;
}

std::string faces(const char* behind) {
    std::string text;
    for (const auto& side : sides)
        text += fmt::format("4 {} {} {} {}{}\n", side[0], side[1], side[2], side[3], behind);
    return text;
}

template <typename Number>
void append(std::string& bytes, Number number, bool turned = false) {
    std::string own(sizeof number, '\0');
    std::memcpy(own.data(), &number, sizeof number);
    bytes.append(turned ? std::string(own.rbegin(), own.rend()) : own);
}

std::string ply(const char* format, const char* end_of_line = "\n") {
    std::string text = fmt::format(
        "ply\nformat {} 1.0\ncomment made by hand\nelement vertex 8\nproperty double x\nproperty double y\n"
        "property double z\nproperty uchar red\nelement face 6\nproperty list uchar uint vertex_indices\n"
        "property float quality\nend_header\n",
        format);
    if (std::string(format) == "ascii") {
        text += lines("", " 7") + faces(" 0.5");
        std::string ended;
        for (const char c : text) c == '\n' ? void(ended += end_of_line) : void(ended += c);
        return ended;
    }
    const bool turned = std::string(format) == "binary_big_endian";
    for (const auto& corner : corners) {
        for (const int coordinate : corner) append(text, static_cast<double>(coordinate), turned);
        append(text, std::uint8_t{7});
    }
    for (const auto& side : sides) {
        append(text, std::uint8_t{4});
        for (const int index : side) append(text, static_cast<std::uint32_t>(index), turned);
        append(text, 0.5F, turned);
    }
    return text;
}

Surface read(const std::string& name, const std::string& bytes) {
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder.file(name, bytes);
    return mended(read_triangles(file, shape_format(file), 300.0));
}

std::string error_of(const std::string& name, const std::string& bytes) {
    const std::string error = test::error_of([&] { read(name, bytes); });
    EXPECT_THAT(error, HasSubstr(name));
    EXPECT_THAT(error, testing::Not(HasSubstr("\n")));
    return error;
}

void expect_the_box(const Surface& surface) {
    EXPECT_EQ(surface.triangle_count(), 12U);
    const VolumeMoments moments = test::moments_of(surface);
    EXPECT_NEAR(moments.volume, 6.0, 1e-12);
    EXPECT_LT((moments.centroid - Vector3d(5.5, 1.0, 1.5)).norm(), 1e-12);
}

TEST(ShapeReader, ReadsPlyInTextAndInBothOrdersOfBytes) {
    expect_the_box(read("a.ply", ply("ascii")));
    expect_the_box(read("a.ply", ply("ascii", "\r\n")));
    expect_the_box(read("a.ply", ply("ascii", "\r")));
    expect_the_box(read("a.ply", "\xEF\xBB\xBF" + ply("ascii")));
    expect_the_box(read("A.PLY", ply("binary_little_endian")));
    expect_the_box(read("a.ply", ply("binary_big_endian")));
}

TEST(ShapeReader, ReadsOffWithColoursNormalsAndComments) {
    expect_the_box(read("a.off", "OFF\n8 6 0\n" + lines("", "") + faces("")));
    expect_the_box(read("a.off", "OFF 8 6 12\n" + lines("", "") + faces(" 255 0 0")));
    expect_the_box(
        read("a.off", "OFF\n# made by hand\n8 6 0\n\n" + lines("", " # here") + "# faces\n" + faces("")));
    expect_the_box(read("a.off", "COFF\n8 6 0\n" + lines("", " 0.1 0.2 0.3 1") + faces("")));
    expect_the_box(read("a.off", "NOFF\n8 6 0\n" + lines("", " 0 0 1") + faces("")));
    expect_the_box(read("a.off",
                        "\xEF\xBB\xBF"
                        "8 6 0\n" +
                            lines("", "") + faces("")));
}

// A glTF of the unit cube, placed by its nodes.
std::string gltf(const std::string& nodes, const std::string& scene, const std::string& uri) {
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":{}}}],"nodes":{},)"
        R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],)"
        R"("buffers":[{{"byteLength":168{}}}],)"
        R"("bufferViews":[{{"buffer":0,"byteLength":96}},{{"buffer":0,"byteOffset":96,"byteLength":72}}],)"
        R"("accessors":[{{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","min":[0,0,0],)"
        R"("max":[1,1,1]}},{{"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}}]}})",
        scene, nodes, uri.empty() ? "" : fmt::format(R"(,"uri":"{}")", uri));
}

std::string buffer_of_cube() {
    std::string bytes;
    for (const auto& corner : corners) {
        for (const int coordinate : {corner[0] - 5, corner[1] / 2, corner[2] / 3})
            append(bytes, static_cast<float>(coordinate));
    }
    for (const auto& side : sides) {
        for (const int i : {0, 1, 2, 0, 2, 3}) append(bytes, static_cast<std::uint16_t>(side[i]));
    }
    return bytes;
}

// One, one of twice the size 3 m along x, and one mirrored, 5 m up and rotated by 90 degrees: up is y in the
// file.
const std::string nodes =
    R"([{"mesh":0},{"mesh":0,"translation":[3,0,0],"scale":[2,2,2]},{"children":[3],"rotation":[0,0.70710678,0,0.70710678]},)"
    R"({"mesh":0,"translation":[0,5,0],"scale":[-1,1,1]}])";

void expect_the_three_cubes(const Surface& surface) {
    EXPECT_EQ(surface.triangle_count(), 36U);
    const VolumeMoments moments = test::moments_of(surface);
    EXPECT_NEAR(moments.volume, 1.0 + 8.0 + 1.0, 1e-6);
    const Eigen::AlignedBox3d box = bounding_box(surface);
    EXPECT_LT((box.max() - Vector3d(5.0, 0.0, 6.0)).norm(), 1.0 + 1e-6);
    EXPECT_NEAR(box.max().z(), 6.0, 1e-6) << "z is up";
}

TEST(ShapeReader, ReadsGltfAsItsNodesPlaceItWithZUp) {
    const std::string buffer = buffer_of_cube();
    expect_the_three_cubes(
        read("a.gltf", gltf(nodes, "[0,1,2]", "data:application/octet-stream;base64," + base64(buffer))));
    const test::TemporaryFolder folder;
    (void)folder.file("parts/a.bin", buffer);
    const auto beside = folder.file("a.gltf", gltf(nodes, "[0,1,2]", "parts/a.bin"));
    expect_the_three_cubes(mended(read_triangles(beside, shape_format(beside), 300.0)));
    std::string json = gltf(nodes, "[0,1,2]", "");
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string glb = "glTF";
    append(glb, std::uint32_t{2});
    append(glb, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + buffer.size()));
    append(glb, static_cast<std::uint32_t>(json.size()));
    glb += "JSON" + json;
    append(glb, static_cast<std::uint32_t>(buffer.size()));
    glb += std::string("BIN\0", 4) + buffer;
    expect_the_three_cubes(read("a.glb", glb));
}

TEST(ShapeReader, LooksForNoFileOutsideOfTheFolderOfAGltf) {
    const test::TemporaryFolder folder;
    (void)folder.file("a.bin", buffer_of_cube());
    const auto file = folder.file("inner/a.gltf", gltf(nodes, "[0]", "../a.bin"));
    EXPECT_THAT(test::error_of([&] { read_triangles(file, shape_format(file), 300.0); }),
                AllOf(HasSubstr("is not a valid .gltf file"), HasSubstr("export it again as .glb")));
}

std::uint32_t crc32(const std::string& bytes) {
    std::uint32_t crc = ~0U;
    for (const char c : bytes) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
    }
    return ~crc;
}

// A zip archive of files that are not compressed.
std::string zip(const std::vector<std::pair<std::string, std::string>>& files) {
    std::string bytes;
    std::string directory;
    for (const auto& [name, content] : files) {
        std::string entry;
        for (const int number : {20, 0, 0, 0, 0x21}) append(entry, static_cast<std::uint16_t>(number));
        append(entry, crc32(content));
        append(entry, static_cast<std::uint32_t>(content.size()));
        append(entry, static_cast<std::uint32_t>(content.size()));
        append(entry, static_cast<std::uint16_t>(name.size()));
        append(entry, std::uint16_t{0});
        directory += std::string("PK\1\2\24\0", 6) + entry + std::string(10, '\0');
        append(directory, static_cast<std::uint32_t>(bytes.size()));
        directory += name;
        bytes += "PK\3\4" + entry + name + content;
    }
    const auto start = static_cast<std::uint32_t>(bytes.size());
    bytes += directory + std::string("PK\5\6\0\0\0\0", 8);
    for (int i = 0; i < 2; ++i) append(bytes, static_cast<std::uint16_t>(files.size()));
    append(bytes, static_cast<std::uint32_t>(directory.size()));
    append(bytes, start);
    return bytes + std::string(2, '\0');
}

// The box twice: as it is and, as a component, twice as large 20 units along x; both 10 units along y.
std::string three_mf(const std::string& unit) {
    std::string mesh = "<mesh><vertices>";
    for (const auto& c : corners)
        mesh += fmt::format("<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>", c[0], c[1], c[2]);
    mesh += "</vertices><triangles>";
    for (const auto& s : sides) {
        mesh +=
            fmt::format("<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/><triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>",
                        s[0], s[1], s[2], s[0], s[2], s[3]);
    }
    const std::string model =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?><model " + unit +
        " xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"><resources><object id=\"1\" "
        "type=\"model\">" +
        mesh +
        "</triangles></mesh></object><object id=\"2\" type=\"model\"><components><component objectid=\"1\"/>"
        "<component objectid=\"1\" transform=\"2 0 0 0 2 0 0 0 2 20 0 0\"/></components></object></resources>"
        "<build><item objectid=\"2\" transform=\"1 0 0 0 1 0 0 0 1 0 10 0\"/></build></model>";
    const std::string types =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?><Types "
        "xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\"><Default Extension=\"rels\" "
        "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/><Default "
        "Extension=\"model\" "
        "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>";
    const std::string relations =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?><Relationships "
        "xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship "
        "Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
        "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";
    return zip({{"[Content_Types].xml", types}, {"_rels/.rels", relations}, {"3D/3dmodel.model", model}});
}

TEST(ShapeReader, Reads3mfInItsUnitWithComponentsWhereTheyArePlaced) {
    const std::pair<const char*, double> units[] = {
        {"", 1e-3}, {"unit=\"millimeter\"", 1e-3}, {"unit=\"inch\"", 0.0254}, {"unit=\"meter\"", 1.0}};
    for (const auto& [unit, metres] : units) {
        const Surface surface = read("a.3mf", three_mf(unit));
        EXPECT_EQ(surface.triangle_count(), 24U);
        EXPECT_NEAR(test::moments_of(surface).volume, (6.0 + 48.0) * metres * metres * metres,
                    1e-5 * metres * metres * metres);
        const Eigen::AlignedBox3d box = bounding_box(surface);
        EXPECT_LT((box.min() - metres * Vector3d(5, 10, 0)).norm(), 1e-6 * metres);
        EXPECT_LT((box.max() - metres * Vector3d(32, 14, 6)).norm(), 1e-5 * metres);
    }
}

TEST(ShapeReader, SaysWhatIsWrongInOneLine) {
    EXPECT_THAT(error_of("a.ply", ply("binary_little_endian").substr(0, 400)),
                HasSubstr("is not a valid PLY file"));
    EXPECT_THAT(error_of("a.ply", "plyx"), HasSubstr("is not a valid PLY file"));
    EXPECT_THAT(error_of("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"),
                HasSubstr("is not a valid OFF file"));
    EXPECT_THAT(error_of("a.off", ""), HasSubstr("is not a valid OFF file"));
    EXPECT_THAT(error_of("a.3mf", "PK"), HasSubstr("is not a valid 3MF file"));
    EXPECT_THAT(error_of("a.gltf", "{}"), HasSubstr(".gltf file"));
    EXPECT_THAT(error_of("a.fbx", "x"), AllOf(HasSubstr("has an unknown format"), HasSubstr("Blender")));
}

}  // namespace
}  // namespace samara
