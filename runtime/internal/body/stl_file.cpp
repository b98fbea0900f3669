#include "internal/body/stl_file.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <sstream>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "internal/files/input_file.hpp"
#include "samara/base/error.hpp"

namespace samara {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

constexpr std::size_t header_size = 84;    // 80 bytes of text, the count of triangles
constexpr std::size_t triangle_size = 50;  // normal, three corners, two bytes

void add_triangle(Surface& surface, const std::array<Vector3d, 3>& corners) {
    const auto first = static_cast<std::int32_t>(surface.vertices.size());
    surface.vertices.insert(surface.vertices.end(), corners.begin(), corners.end());
    surface.corners.push_back({first, first + 1, first + 2});
}

std::uint32_t triangle_count_in_header(std::string_view bytes) {
    std::uint32_t count = 0;
    if (bytes.size() >= header_size) std::memcpy(&count, bytes.data() + 80, sizeof count);
    return count;
}

// Binary files may start with "solid" too, so the size decides; a text file has a facet or its end after the
// name.
bool is_text(std::string_view bytes) {
    const std::size_t start = bytes.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos || !bytes.substr(start).starts_with("solid")) return false;
    if (bytes.size() == header_size + triangle_size * std::size_t{triangle_count_in_header(bytes)})
        return false;
    return bytes.find('\0') == std::string_view::npos;
}

Surface read_binary(std::string_view bytes, const std::string& name) {
    const std::uint32_t count = triangle_count_in_header(bytes);
    const std::size_t expected = header_size + triangle_size * std::size_t{count};
    if (bytes.size() < expected || bytes.size() < header_size) {
        throw Error(fmt::format(
            "{}: is no STL file, or is cut short: {} bytes, where {} triangles take {}; export it "
            "again",
            name, bytes.size(), count, expected));
    }
    Surface surface;
    for (std::size_t t = 0; t < count; ++t) {
        std::array<float, 9> values{};
        std::memcpy(values.data(), bytes.data() + header_size + t * triangle_size + 3 * sizeof(float),
                    sizeof values);
        std::array<Vector3d, 3> corners;
        for (std::size_t i = 0; i < 3; ++i) {
            corners[i] = Vector3d(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
        }
        add_triangle(surface, corners);
    }
    return surface;
}

double number(std::istringstream& words, const std::string& name, int line) {
    std::string word;
    words >> word;
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (word.empty() || *end != '\0') {
        throw Error(fmt::format("{}: line {}: 'vertex' needs three numbers, not '{}'", name, line, word));
    }
    return value;
}

Surface read_text(const std::string& bytes, const std::string& name) {
    Surface surface;
    std::array<Vector3d, 3> corners;
    std::size_t count = 0;
    bool in_loop = false;
    std::istringstream stream(bytes);
    int line = 0;
    for (std::string text; std::getline(stream, text);) {
        ++line;
        std::istringstream words(text);
        std::string keyword;
        words >> keyword;
        if (keyword == "outer") {
            in_loop = true;
            count = 0;
        } else if (keyword == "vertex") {
            if (!in_loop || count == 3) {
                throw Error(
                    fmt::format("{}: line {}: a face has three vertices within its loop", name, line));
            }
            const double x = number(words, name, line);
            const double y = number(words, name, line);
            corners[count++] = Vector3d(x, y, number(words, name, line));
        } else if (keyword == "endloop") {
            if (count != 3)
                throw Error(fmt::format("{}: line {}: the face has {} vertices", name, line, count));
            add_triangle(surface, corners);
            in_loop = false;
        }
    }
    if (in_loop)
        throw Error(fmt::format("{}: is cut short within a face at line {}; export it again", name, line));
    return surface;
}

}  // namespace

Surface read_stl_file(const std::filesystem::path& file) {
    const std::string bytes = read_at_most(file, most_mesh_bytes);
    if (bytes.empty()) throw Error(fmt::format("{}: is empty; export it again", file.string()));
    return is_text(bytes) ? read_text(bytes, file.string()) : read_binary(bytes, file.string());
}

}  // namespace samara
