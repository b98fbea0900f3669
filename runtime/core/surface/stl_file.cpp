#include "samara/core/surface/stl_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/files/input_file.hpp"
#include "samara/core/surface/mesh_text.hpp"

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

bool has_size_of_binary(std::string_view bytes) {
    return bytes.size() == header_size + triangle_size * std::size_t{triangle_count_in_header(bytes)};
}

bool is_text(std::string_view bytes) {
    const std::size_t start = bytes.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos || bytes.find('\0') != std::string_view::npos) return false;
    const std::string first = in_small_letters(bytes.substr(start, 5));
    return first == "solid" || first == "facet";
}

Surface read_binary(std::string_view bytes, const std::string& name) {
    const std::uint32_t count = triangle_count_in_header(bytes);
    const std::size_t expected = header_size + triangle_size * std::size_t{count};
    const bool is_text = std::none_of(bytes.begin(), bytes.end(), [](unsigned char c) { return c == 0; });
    if (bytes.size() < header_size || (is_text && bytes.size() < expected)) {
        throw Error(
            fmt::format("{}: is not an STL file: a text file begins with 'solid', and a binary file has more "
                        "than {} bytes; export it again",
                        name, bytes.size()));
    }
    if (bytes.size() < expected) {
        throw Error(
            fmt::format("{}: is not an STL file, or is truncated: it has {} bytes, but {} triangles need {}; "
                        "export it again",
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

class TextReader {
  public:
    explicit TextReader(std::string label) : label_(std::move(label)) {}

    Surface read(std::string_view text) {
        constexpr bool continued = false;
        visit_lines(text, continued, [&](std::string_view line, int number) {
            line_ = number;
            read_line(line);
        });
        if (in_loop_) {
            throw Error(
                fmt::format("{}: is truncated within a face at line {}; export it again", label_, line_));
        }
        return std::move(surface_);
    }

  private:
    // The name of the solid is ignored; all else may stand on one line.
    void read_line(std::string_view line) {
        Words words(line);
        std::string keyword = in_small_letters(words.next());
        if (keyword == "solid" || keyword == "endsolid") {
            const std::size_t facet = in_small_letters(line).find("facet normal");
            if (facet == std::string::npos) return;
            words = Words(line.substr(facet));
        }
        for (; !keyword.empty(); keyword = in_small_letters(words.next())) {
            if (keyword == "outer") {
                in_loop_ = true;
                count_ = 0;
            } else if (keyword == "vertex") {
                add_corner(words);
            } else if (keyword == "endloop") {
                if (count_ != 3) fail(fmt::format("the face has {} vertices", count_));
                add_triangle(surface_, corners_);
                in_loop_ = false;
            }
        }
    }

    void add_corner(Words& words) {
        if (!in_loop_ || count_ == 3) fail("a face has three vertices within its loop");
        for (double& coordinate : corners_[count_++]) {
            const std::string_view word = words.next();
            if (!read_number(word, coordinate)) {
                fail(fmt::format("'vertex' needs three numbers, not '{}'", word));
            }
        }
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw Error(fmt::format("{}: line {}: {}", label_, line_, what));
    }

    std::string label_;
    int line_ = 0;
    Surface surface_;
    std::array<Vector3d, 3> corners_;
    std::size_t count_ = 0;
    bool in_loop_ = false;
};

}  // namespace

Surface read_stl(const std::string& bytes, const std::string& label) {
    if (bytes.empty()) throw Error(fmt::format("{}: is empty; export it again", label));
    // Binary files may start with "solid" too, so the size decides.
    if (has_size_of_binary(bytes)) return read_binary(bytes, label);
    const std::string_view text = without_byte_order_mark(bytes, label);
    return is_text(text) ? TextReader(label).read(text) : read_binary(bytes, label);
}

Surface read_stl_file(const std::filesystem::path& file) {
    return read_stl(read_at_most(file, most_mesh_bytes), file.string());
}

}  // namespace samara
