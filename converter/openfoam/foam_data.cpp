#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "converter/openfoam/foam_file.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"

namespace samara {
namespace {

/// Names of entries, and the start of a type, that make OpenFOAM load a library or compile code.
constexpr std::string_view names_of_code[] = {"libs", "functionObjectLibs", "functions", "fvOptions", "code"};
constexpr std::string_view type_of_code = "coded";

/// The size of a value in a binary list, in labels or scalars.
struct BinaryValue {
    std::string_view name;
    std::size_t labels;
    std::size_t scalars;
};

constexpr BinaryValue values_of_lists[] = {{"List<label>", 1, 0},      {"List<scalar>", 0, 1},
                                           {"List<vector>", 0, 3},     {"List<tensor>", 0, 9},
                                           {"List<symmTensor>", 0, 6}, {"List<sphericalTensor>", 0, 1}};

/// Classes of files that consist of a list, or two, without their type.
constexpr BinaryValue values_of_classes[] = {
    {"labelList", 1, 0}, {"faceCompactList", 1, 0}, {"scalarField", 0, 1}, {"vectorField", 0, 3}};

const BinaryValue* found_in(std::string_view name, const BinaryValue* first, const BinaryValue* last) {
    const BinaryValue* const found =
        std::find_if(first, last, [&](const BinaryValue& one) { return one.name == name; });
    return found == last ? nullptr : found;
}

/// Scans a file as OpenFOAM does: tokens, comments, quoted texts and blocks of bytes.
class DataScan {
  public:
    DataScan(const std::filesystem::path& path, std::string_view text) : path_(path), text_(text) {}

    void run() {
        read_header();
        while (skip_blanks()) {
            if (is_digit(here()) && is_plain_list()) {
                skip_plain_list();
            } else {
                pass_token();
            }
        }
    }

  private:
    static bool is_digit(char c) { return c >= '0' && c <= '9'; }
    [[nodiscard]] char here() const { return place_ < text_.size() ? text_[place_] : '\0'; }

    [[nodiscard]] Error error(const std::string& what) const {
        const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(place_, text_.size()));
        return Error(fmt::format("{}:{}: {}, which is not allowed there", path_.string(),
                                 1 + std::count(text_.begin(), end, '\n'), what));
    }

    /// Passes over blanks and comments; returns whether anything is left.
    bool skip_blanks() {
        while (place_ < text_.size()) {
            const std::string_view rest = text_.substr(place_);
            if (std::isspace(static_cast<unsigned char>(rest.front())) != 0) {
                ++place_;
            } else if (rest.starts_with("//")) {
                place_ = std::min(text_.find('\n', place_), text_.size());
            } else if (rest.starts_with("/*")) {
                const std::size_t end = text_.find("*/", place_ + 2);
                place_ = end == std::string_view::npos ? text_.size() : end + 2;
            } else {
                return true;
            }
        }
        return false;
    }

    std::string_view word() {
        const std::size_t start = place_;
        constexpr std::string_view ends = "(){}[];\"#$";
        while (place_ < text_.size() && std::isspace(static_cast<unsigned char>(here())) == 0 &&
               ends.find(here()) == std::string_view::npos) {
            ++place_;
        }
        return text_.substr(start, place_ - start);
    }

    /// Skips a text in quotes, which is a value; as a name it would be a pattern that matches others.
    void pass_quoted() {
        for (++place_; place_ < text_.size() && here() != '"'; ++place_) {
            if (here() == '\\') ++place_;
        }
        ++place_;
        if (skip_blanks() && here() != ';') throw error("holds a name in quotes");
    }

    void pass_token() {
        const char c = here();
        if (c == '#' || c == '$') {
            ++place_;
            throw error(fmt::format("holds '{}{}'", c, word()));
        }
        if (c == '"') return pass_quoted();
        const std::string_view token = word();
        if (token.empty()) {
            ++place_;
            return;
        }
        const bool names_code = std::ranges::find(names_of_code, token) != std::end(names_of_code);
        if (names_code || token.starts_with(type_of_code)) throw error(fmt::format("holds '{}'", token));
        if (is_binary_ && token.find("List<") != std::string_view::npos) {
            const BinaryValue* const value =
                found_in(token, std::begin(values_of_lists), std::end(values_of_lists));
            if (value == nullptr) throw error(fmt::format("holds a binary '{}'", token));
            skip_values(*value);
        }
    }

    [[nodiscard]] bool is_plain_list() const { return is_binary_ && of_class_ != nullptr; }
    void skip_plain_list() { skip_values(*of_class_); }

    /// Passes over "COUNT(BYTES)"; anything else is left to be read as tokens.
    void skip_values(const BinaryValue& value) {
        if (!skip_blanks()) return;
        std::size_t count = 0;
        const char* const last = text_.data() + text_.size();
        const auto [end, status] = std::from_chars(text_.data() + place_, last, count);
        if (status != std::errc()) throw error("holds a binary list without its length");
        place_ = static_cast<std::size_t>(end - text_.data());
        if (!skip_blanks() || here() == '{' || (count == 0 && here() != '(')) return;
        if (here() != '(') throw error("holds a binary list that does not begin");
        const std::size_t bytes = value.labels * label_bytes_ + value.scalars * scalar_bytes_;
        const std::size_t left = text_.size() - place_ - 1;
        if (count > left / bytes) {
            place_ = text_.size();  // cut short
            return;
        }
        place_ += 1 + count * bytes;
        if (place_ < text_.size() && here() != ')') throw error("holds a binary list that does not end");
    }

    /// Reads the value of an entry of the header.
    std::string_view header_value() {
        skip_blanks();
        const std::size_t start = place_;
        if (here() == '"') {
            place_ = text_.find('"', place_ + 1);
            place_ = place_ == std::string_view::npos ? text_.size() : place_ + 1;
        } else {
            word();
        }
        const std::string_view value = text_.substr(start, place_ - start);
        if (skip_blanks() && here() != ';') throw error("holds a header of an unknown form");
        ++place_;
        return value;
    }

    void read_header() {
        if (!skip_blanks()) return;
        if (word() != "FoamFile" || !skip_blanks() || here() != '{')
            throw error("does not begin with FoamFile {");
        ++place_;
        constexpr std::string_view known[] = {"version", "format", "class", "location",
                                              "object",  "arch",   "note"};
        std::string seen;
        while (skip_blanks() && here() != '}') {
            const std::string name = fmt::format("{} ", word());
            const bool is_known = std::ranges::find(known, std::string_view(name).substr(
                                                               0, name.size() - 1)) != std::end(known);
            if (!is_known || (" " + seen).find(" " + name) != std::string::npos) {
                throw error(
                    fmt::format("holds a header with the entry '{}'", name.substr(0, name.size() - 1)));
            }
            seen += name;
            const std::string_view value = header_value();
            if (name == "format ") {
                is_binary_ = value == "binary";
                if (!is_binary_ && value != "ascii") throw error("holds a header of an unknown format");
            }
            if (name == "class ") {
                of_class_ = found_in(value, std::begin(values_of_classes), std::end(values_of_classes));
            }
            if (name == "arch ") {
                label_bytes_ = value.find("label=64") != std::string_view::npos ? 8 : 4;
                scalar_bytes_ = value.find("scalar=32") != std::string_view::npos ? 4 : 8;
            }
        }
        ++place_;
    }

    const std::filesystem::path& path_;
    std::string_view text_;
    std::size_t place_ = 0;
    bool is_binary_ = false;
    const BinaryValue* of_class_ = nullptr;  // where the file is a list
    std::size_t label_bytes_ = 4;
    std::size_t scalar_bytes_ = 8;
};

}  // namespace

void require_foam_data(const std::filesystem::path& file) {
    const std::string text = read_bytes(file);
    DataScan(file, text).run();
}

}  // namespace samara
