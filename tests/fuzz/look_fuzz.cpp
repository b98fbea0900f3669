// Meshes that are shown, and obstacles: .glb as it is (it begins with "glTF"), .glb from its parts (JSON,
// which begins with '{', up to the first zero byte, then the bytes of its buffer; the lengths of the
// container are made here, so that what the fuzzer changes is read), and .obj with all that a picture needs
// (anything else).

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "harness.hpp"
#include "samara/core/files/folders.hpp"
#include "samara/core/surface/obj_file.hpp"
#include "samara/formats/display_mesh_file.hpp"

namespace samara::fuzz {
namespace {

std::string four_bytes(std::size_t number) {
    std::string bytes;
    for (int i = 0; i < 4; ++i, number >>= 8) bytes += static_cast<char>(number & 0xff);
    return bytes;
}

std::string container(std::string_view parts) {
    const std::size_t end = std::min(parts.find('\0'), parts.size());
    std::string json(parts.substr(0, end));
    std::string binary(parts.substr(std::min(end + 1, parts.size())));
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    const std::size_t size = 12 + 8 + json.size() + 8 + binary.size();
    return "glTF" + four_bytes(2) + four_bytes(size) + four_bytes(json.size()) + "JSON" + json +
           four_bytes(binary.size()) + std::string("BIN\0", 4) + binary;
}

void require_whole(const DisplayMesh& display) {
    const auto vertices = static_cast<std::int32_t>(display.positions.size());
    const auto materials = static_cast<std::int32_t>(display.materials.size());
    require(display.normals.empty() || display.normals.size() == display.positions.size(),
            "a normal at each vertex");
    require(display.texture.empty() || display.texture.size() == display.positions.size(),
            "a place on the image at each vertex");
    require(display.slots.size() == display.corners.size(), "each triangle has a slot");
    for (const auto& triangle : display.corners) {
        for (const std::int32_t corner : triangle)
            require(corner >= 0 && corner < vertices, "corners are there");
    }
    for (const std::int32_t slot : display.slots)
        require(slot >= 0 && slot < materials, "materials are there");
    for (const Vector3d& place : display.positions) require(place.allFinite(), "places are numbers");
    for (const Vector3d& normal : display.normals)
        require(std::abs(normal.norm() - 1.0) < 1e-6, "normals are of length one");
}

}  // namespace

void feed(std::string_view input) {
    static const TemporaryFolder folder;
    const bool is_glb = input.starts_with("glTF") || input.starts_with('{');
    const std::filesystem::path file = folder / (is_glb ? "look.glb" : "look.obj");
    std::ofstream(file, std::ios::binary) << (input.starts_with('{') ? container(input) : std::string(input));
    const auto display = accepted([&] { return is_glb ? read_glb_file(file) : read_obj_display_mesh(file); });
    if (display) require_whole(*display);
}

}  // namespace samara::fuzz
