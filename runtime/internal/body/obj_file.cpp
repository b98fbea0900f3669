#include "internal/body/obj_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "internal/base/content_hash.hpp"
#include "internal/body/polygon_triangles.hpp"
#include "samara/base/error.hpp"

namespace samara {
namespace {

// The words of one line, from the left.
class Words {
  public:
    explicit Words(std::string_view line) : rest_(line) {}

    // Empty after the last one.
    std::string_view next() {
        constexpr std::string_view blanks = " \t";
        rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
        const std::string_view word = rest_.substr(0, rest_.find_first_of(blanks));
        rest_.remove_prefix(word.size());
        return word;
    }

  private:
    std::string_view rest_;
};

class ObjReader {
  public:
    explicit ObjReader(std::string label) : label_(std::move(label)) {}

    Surface read(std::string_view text) {
        // Lines end as on Unix, on Windows, or as on Macs of old.
        while (!text.empty()) {
            const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
            ++line_;
            read_line(text.substr(0, end));
            text.remove_prefix(end);
            text.remove_prefix(text.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, text.size()));
        }
        return surface_;
    }

  private:
    void read_line(std::string_view line) {
        Words words(line);
        const std::string_view keyword = words.next();
        if (keyword == "v") add_vertex(words);
        if (keyword == "f") add_face(words);
    }

    void add_vertex(Words& words) {
        if (surface_.vertices.size() == std::numeric_limits<std::int32_t>::max()) fail("too many vertices");
        Vector3d& vertex = surface_.vertices.emplace_back();
        for (double& coordinate : vertex) {
            std::string_view word = words.next();
            const std::string_view whole = word;
            if (word.starts_with('+')) word.remove_prefix(1);
            const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), coordinate);
            const bool is_read = failure == std::errc{} && end == word.data() + word.size();
            if (!is_read || !std::isfinite(coordinate)) {
                fail(fmt::format("'v' needs three numbers, not '{}'", whole));
            }
        }
    }

    void add_face(Words& words) {
        corners_.clear();
        for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
            corners_.push_back(vertex_of(word));
        }
        if (corners_.size() < 3)
            fail(fmt::format("a face has three or more corners, not {}", corners_.size()));
        if (corners_.size() > most_obj_corners) {
            fail(fmt::format(
                "a face of {} corners, where {} are the most; cut it into triangles where the file is "
                "made",
                corners_.size(), most_obj_corners));
        }
        const auto triangles = polygon_triangles(surface_.vertices, corners_);
        surface_.corners.insert(surface_.corners.end(), triangles.begin(), triangles.end());
    }

    // Of VERTEX, VERTEX/TEXTURE, VERTEX//NORMAL or VERTEX/TEXTURE/NORMAL; counted from 1, or back from the
    // last.
    [[nodiscard]] std::int32_t vertex_of(std::string_view word) const {
        const std::string_view digits = word.substr(0, word.find('/'));
        const auto count = static_cast<std::int64_t>(surface_.vertices.size());
        std::int64_t number = 0;
        const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
        const bool is_read = failure == std::errc{} && end == digits.data() + digits.size();
        if (!is_read || number == 0 || number > count || number < -count) {
            fail(fmt::format("a face names vertex '{}' of {}", word, count));
        }
        return static_cast<std::int32_t>(number > 0 ? number - 1 : count + number);
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw Error(fmt::format("{}: line {}: {}", label_, line_, what));
    }

    std::string label_;
    int line_ = 0;
    Surface surface_;
    std::vector<std::int32_t> corners_;
};

}  // namespace

Surface read_obj_file(const std::filesystem::path& file) {
    return ObjReader(file.string()).read(read_bytes(file));
}

}  // namespace samara
