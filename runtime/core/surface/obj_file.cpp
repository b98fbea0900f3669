#include "samara/core/surface/obj_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/files/input_file.hpp"
#include "samara/core/surface/display_image.hpp"
#include "samara/core/surface/mesh_text.hpp"
#include "samara/core/surface/polygon_triangles.hpp"

namespace samara {
namespace {

constexpr std::size_t most_materials = 4096;
constexpr std::size_t most_material_bytes = 64U << 20U;  // the largest file of materials (bytes)

/// Reads a number and clamps it to 0 to 1; false where the word is none.
bool read_share(std::string_view word, double& number) {
    if (!read_number(word, number) || !std::isfinite(number)) return false;
    number = std::clamp(number, 0.0, 1.0);
    return true;
}

class ObjReader {
  public:
    explicit ObjReader(std::string label, bool with_display = false)
        : label_(std::move(label)), with_display_(with_display) {}

    Surface read(std::string_view text) {
        constexpr bool continued = true;
        visit_lines(without_byte_order_mark(text, label_), continued, [&](std::string_view line, int number) {
            line_ = number;
            read_line(line);
        });
        return surface_;
    }

    /// Returns the display mesh that was read.
    DisplayMesh display(const std::filesystem::path& folder) {
        for (const std::string& library : libraries_) read_materials(place_beneath(folder, library), folder);
        if (!all_have_normals_) display_.normals.clear();
        if (texture_.empty()) display_.texture.clear();
        return std::move(display_);
    }

  private:
    void read_line(std::string_view line) {
        // Names may hold a '#', numbers cannot.
        Words words(line);
        const std::string keyword = in_small_letters(words.next());
        const std::string_view rest = words.rest();
        Words numbers_alone(rest.substr(0, rest.find('#')));
        if (keyword == "v") add_vertex(numbers_alone);
        if (keyword == "f") add_face(numbers_alone);
        if (!with_display_) return;
        if (keyword == "vt") texture_.push_back(numbers<2>("vt", "two", numbers_alone));
        if (keyword == "vn") normals_.push_back(numbers<3>("vn", "three", numbers_alone));
        if (keyword == "usemtl") slot_ = slot_named(std::string(words.next()));
        if (keyword != "mtllib") return;
        const std::string library(words.next());
        if (known_libraries_.insert(library).second) libraries_.push_back(library);
    }

    template <int N>
    Eigen::Matrix<double, N, 1> numbers(const char* keyword, const char* how_many, Words& words) {
        Eigen::Matrix<double, N, 1> vector;
        for (double& coordinate : vector) {
            const std::string_view word = words.next();
            if (!read_number(word, coordinate) || !std::isfinite(coordinate)) {
                fail(fmt::format("'{}' needs {} numbers, not '{}'", keyword, how_many, word));
            }
        }
        return vector;
    }

    void add_vertex(Words& words) {
        if (surface_.vertices.size() == std::numeric_limits<std::int32_t>::max()) fail("too many vertices");
        surface_.vertices.push_back(numbers<3>("v", "three", words));
    }

    std::int32_t slot_named(const std::string& name) {
        const auto [known, is_new] =
            slots_.try_emplace(name, static_cast<std::int32_t>(display_.materials.size()));
        if (!is_new) return known->second;
        if (display_.materials.size() == most_materials) fail("too many materials");
        display_.materials.emplace_back().name = name;
        return known->second;
    }

    /// Returns the path of a file that this one names: the named path, unless that is outside of the folder,
    /// else beside this file; empty where there is none.
    static std::filesystem::path place_beneath(const std::filesystem::path& folder,
                                               const std::filesystem::path& name) {
        const auto is_there = [](const std::filesystem::path& file) {
            std::error_code unknown;
            return std::filesystem::exists(file, unknown) && !std::filesystem::is_directory(file, unknown);
        };
        const bool leads_out = name.is_absolute() || std::find(name.begin(), name.end(), "..") != name.end();
        if (!leads_out && is_there(folder / name)) return folder / name;
        return is_there(folder / name.filename()) ? folder / name.filename() : std::filesystem::path{};
    }

    /// A link could otherwise show any file that the user may read.
    void require_beneath(const InputFile& input, const std::filesystem::path& folder) const {
        if (input.is_beneath(folder)) return;
        throw Error(fmt::format("{}: {} is a link to outside of the folder; replace it by the file", label_,
                                input.path().string()));
    }

    /// Returns the number of the image that a line of a file of materials names behind its options, at
    /// place_beneath(); -1 where there is none to carry.
    std::int32_t image_named(std::string_view rest, const std::filesystem::path& folder) {
        rest.remove_prefix(std::min(rest.find_first_not_of(Words::blanks), rest.size()));
        rest.remove_suffix(rest.size() - std::min(rest.find_last_not_of(Words::blanks) + 1, rest.size()));
        if (rest.starts_with('-')) rest.remove_prefix(rest.find_last_of(Words::blanks) + 1);
        std::string name(rest);
        std::replace(name.begin(), name.end(), '\\', '/');
        const std::filesystem::path file = place_beneath(folder, name);
        const auto [known, is_new] = images_.try_emplace(file.string(), -1);
        if (!is_new || file.empty()) return known->second;
        const InputFile input(file);
        require_beneath(input, folder);
        if (input.size() > most_image_bytes) return -1;
        std::string bytes = input.bytes(most_image_bytes);
        if (image_type(bytes) == nullptr) return -1;
        if (!add_image(display_, {file.stem().string(), std::move(bytes)})) {
            throw Error(fmt::format("{}: {}", label_, too_many_images));
        }
        known->second = static_cast<std::int32_t>(display_.images.size()) - 1;
        return known->second;
    }

    /// Reads the materials of a file, where it can be read.
    void read_materials(const std::filesystem::path& file, const std::filesystem::path& folder) {
        if (file.empty()) return;
        const InputFile input(file);
        require_beneath(input, folder);
        DisplayMaterial* material = nullptr;
        const std::string text = input.bytes(most_material_bytes);
        constexpr bool continued = false;
        visit_lines(without_byte_order_mark(text, file.string()), continued, [&](std::string_view line, int) {
            Words words(line);
            const std::string keyword = in_small_letters(words.next());
            if (keyword == "newmtl") {
                const auto found = slots_.find(std::string(words.next()));
                material = found == slots_.end()
                               ? nullptr
                               : &display_.materials[static_cast<std::size_t>(found->second)];
            }
            if (material == nullptr) return;
            double number = 0.0;
            for (std::size_t i = 0; keyword == "kd" && i < 3; ++i) {
                if (read_share(words.next(), number)) material->color[i] = number;
            }
            if (keyword == "d" && read_share(words.next(), number)) material->color[3] = number;
            if (keyword == "map_kd") material->image = image_named(words.rest(), folder);
            if (keyword == "map_d") material->transparency = DisplayTransparency::cut_out;
        });
    }

    /// Returns the vertex of the display mesh that a face's word names; equal words share one.
    std::int32_t display_vertex(const std::string& word, std::int32_t vertex) {
        const auto [known, is_new] = known_.try_emplace(word, display_.positions.size());
        if (!is_new) return static_cast<std::int32_t>(known->second);
        display_.positions.push_back(surface_.vertices[static_cast<std::size_t>(vertex)]);
        const auto part = [&](int index) {
            std::string_view rest = word;
            for (int i = 0; i < index; ++i) {
                const std::size_t slash = rest.find('/');
                rest.remove_prefix(slash == std::string_view::npos ? rest.size() : slash + 1);
            }
            return rest.substr(0, rest.find('/'));
        };
        const std::string_view texture = part(1);
        display_.texture.push_back(texture.empty() ? Eigen::Vector2d(0.0, 0.0)
                                                   : texture_[index_of(texture, texture_.size(), "texture")]);
        const std::string_view normal = part(2);
        all_have_normals_ = all_have_normals_ && !normal.empty();
        display_.normals.push_back(normal.empty()
                                       ? Vector3d::UnitZ()
                                       : unit_normal(normals_[index_of(normal, normals_.size(), "normal")]));
        return static_cast<std::int32_t>(display_.positions.size()) - 1;
    }

    void add_to_display(const std::vector<std::array<std::int32_t, 3>>& triangles) {
        if (slot_ < 0) slot_ = slot_named("body");
        std::vector<std::int32_t> vertices;
        for (std::size_t i = 0; i < corners_.size(); ++i)
            vertices.push_back(display_vertex(words_[i], corners_[i]));
        for (const auto& triangle : triangles) {
            std::array<std::int32_t, 3> corners{};
            for (std::size_t k = 0; k < 3; ++k) {
                const auto place =
                    std::find(corners_.begin(), corners_.end(), triangle[k]) - corners_.begin();
                corners[k] = vertices[static_cast<std::size_t>(place)];
            }
            display_.corners.push_back(corners);
            display_.slots.push_back(slot_);
        }
    }

    void add_face(Words& words) {
        corners_.clear();
        words_.clear();
        for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
            corners_.push_back(static_cast<std::int32_t>(index_of(word, surface_.vertices.size(), "vertex")));
            if (with_display_) words_.emplace_back(absolute(word));
        }
        if (corners_.size() < 3)
            fail(fmt::format("a face must have three or more corners, not {}", corners_.size()));
        if (corners_.size() > most_obj_corners) {
            fail(fmt::format("a face has {} corners, more than {}; export the file with triangles",
                             corners_.size(), most_obj_corners));
        }
        const auto triangles = polygon_triangles(surface_.vertices, corners_);
        surface_.corners.insert(surface_.corners.end(), triangles.begin(), triangles.end());
        if (with_display_) add_to_display(triangles);
    }

    /// Returns a face's word with numbers that count from 1: those that count back differ from line to line.
    [[nodiscard]] std::string absolute(std::string_view word) const {
        if (word.find('-') == std::string_view::npos) return std::string(word);
        const std::size_t counts[] = {surface_.vertices.size(), texture_.size(), normals_.size()};
        const char* names[] = {"vertex", "texture", "normal"};
        std::string result;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t slash = word.find('/');
            const std::string_view part = word.substr(0, slash);
            if (!part.empty()) result += fmt::format("{}", index_of(part, counts[i], names[i]) + 1);
            if (slash == std::string_view::npos) break;
            result += '/';
            word.remove_prefix(slash + 1);
        }
        return result;
    }

    // Returns the first index of VERTEX, VERTEX/TEXTURE, VERTEX//NORMAL or VERTEX/TEXTURE/NORMAL, less than
    // `all`; the file counts from 1, or back from the last.
    [[nodiscard]] std::size_t index_of(std::string_view word, std::size_t all, const char* what) const {
        const std::string_view digits = word.substr(0, word.find('/'));
        const auto count = static_cast<std::int64_t>(all);
        std::int64_t number = 0;
        const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
        const bool is_read = failure == std::errc{} && end == digits.data() + digits.size();
        if (!is_read || number == 0 || number > count || number < -count) {
            fail(fmt::format("a face refers to {} '{}' of {}", what, word, count));
        }
        return static_cast<std::size_t>(number > 0 ? number - 1 : count + number);
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw Error(fmt::format("{}: line {}: {}", label_, line_, what));
    }

    std::string label_;
    int line_ = 0;
    Surface surface_;
    std::vector<std::int32_t> corners_;  // of the present face
    std::vector<std::string> words_;     // likewise

    bool with_display_;
    DisplayMesh display_;
    std::int32_t slot_ = -1;
    bool all_have_normals_ = true;
    std::vector<Eigen::Vector2d> texture_;
    std::vector<Vector3d> normals_;
    std::vector<std::string> libraries_;
    std::set<std::string> known_libraries_;
    std::unordered_map<std::string, std::int32_t> slots_;   // by name: the materials of the display mesh
    std::unordered_map<std::string, std::int32_t> images_;  // by file: their numbers in the display mesh
    std::unordered_map<std::string, std::size_t> known_;
};

}  // namespace

Surface read_obj_file(const std::filesystem::path& file) {
    return ObjReader(file.string()).read(read_at_most(file, most_mesh_bytes));
}

DisplayMesh read_obj_display_mesh(const std::filesystem::path& file) {
    ObjReader reader(file.string(), true);
    reader.read(read_at_most(file, most_mesh_bytes));
    return reader.display(file.parent_path());
}

}  // namespace samara
