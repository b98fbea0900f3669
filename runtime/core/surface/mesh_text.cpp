#include "samara/core/surface/mesh_text.hpp"

#include <cctype>
#include <charconv>
#include <system_error>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"

namespace samara {

std::string_view without_byte_order_mark(std::string_view text, const std::string& label) {
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    if (text.starts_with(mark)) return text.substr(mark.size());
    using namespace std::string_view_literals;
    if (text.starts_with("\xFF\xFE"sv) || text.starts_with("\xFE\xFF"sv) ||
        text.starts_with("\0\0\xFE\xFF"sv)) {
        throw Error(fmt::format("{}: is text in UTF-16 or UTF-32; save it as UTF-8 or plain text", label));
    }
    return text;
}

bool read_number(std::string_view word, double& number) {
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (end != word.data() + word.size()) return false;
    if (failure != std::errc::result_out_of_range) return failure == std::errc{};
    number = 0.0;
    return word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
}

std::string in_small_letters(std::string_view word) {
    std::string small(word);
    std::transform(small.begin(), small.end(), small.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return small;
}

}  // namespace samara
