#include "samara/formats/toml_keys.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"

namespace samara {
namespace {

constexpr int most_parts = 8;

/// The place behind the string that begins at `begin` with one of the quotes ' and ", or with three; behind
/// the line's end where it is not closed, which the parser refuses.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
    const char quote = text[begin];
    const std::string three(3, quote);
    const bool long_one = text.substr(begin, 3) == three;
    std::size_t at = begin + (long_one ? 3 : 1);
    while (at < text.size()) {
        if (text[at] == '\\' && quote == '"') {
            at += 2;
        } else if (long_one && text.substr(at, 3) == three) {
            at += 3;
            for (int i = 0; i < 2 && at < text.size() && text[at] == quote; ++i)
                ++at;  // they end the content
            return at;
        } else if (!long_one && (text[at] == quote || text[at] == '\n')) {
            return at + 1;
        } else {
            ++at;
        }
    }
    return text.size();
}

}  // namespace

void require_short_keys(std::string_view text, const std::string& file) {
    int parts = 1;
    for (std::size_t at = 0; at < text.size();) {
        const char letter = text[at];
        if (letter == '"' || letter == '\'') {
            at = end_of_string(text, at);
            continue;
        }
        if (letter == '#') {
            at = std::min(text.find('\n', at), text.size());
            continue;
        }
        if (std::string_view("=,[]{}\n").find(letter) != std::string_view::npos) parts = 1;
        if (letter == '.' && ++parts > most_parts) {
            const auto line =
                1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
            throw Error(fmt::format("{}:{}: a key has more than {} parts joined by dots; which one is meant?",
                                    file, line, most_parts));
        }
        ++at;
    }
}

}  // namespace samara
