#include "samara/core/base/text.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>

#include <fmt/format.h>

namespace samara {
namespace {

/// A character in UTF-8: its length in bytes, 0 where the bytes are none, and its code point.
struct Character {
    std::size_t bytes = 0;
    std::uint32_t code = 0;
};

Character first_character(std::string_view text) {
    const auto byte = [&](std::size_t i) -> std::uint32_t { return static_cast<unsigned char>(text[i]); };
    const std::uint32_t lead = byte(0);
    if (lead < 0x80) return {1, lead};
    const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc0 || lead > 0xf4 || text.size() < bytes) return {};
    std::uint32_t code = lead & (0x7fU >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xc0U) != 0x80U) return {};
        code = code << 6U | (byte(i) & 0x3fU);
    }
    constexpr std::uint32_t least[] = {
        0, 0, 0x80, 0x800,
        0x10000};  // the least code point of each length: longer encodings of the same are invalid
    const bool surrogate = code >= 0xd800 && code <= 0xdfff;
    if (code < least[bytes] || code > 0x10ffff || surrogate) return {};
    return {bytes, code};
}

bool is_obeyed(std::uint32_t code) {
    const auto within = [code](std::uint32_t first, std::uint32_t last) {
        return code >= first && code <= last;
    };
    return code < 0x20 || within(0x7f, 0x9f) || code == 0x61c || within(0x200e, 0x200f) ||
           within(0x2028, 0x202e) || within(0x2066, 0x2069);
}

std::string shown(std::string_view text, bool keep_lines) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string result;
    result.reserve(text.size());
    while (!text.empty()) {
        const Character character = first_character(text);
        const std::string_view bytes = text.substr(0, character.bytes == 0 ? 1 : character.bytes);
        const bool of_lines = keep_lines && (bytes == "\n" || bytes == "\t");
        const bool stays = character.bytes > 0 && (!is_obeyed(character.code) || of_lines);
        if (stays) {
            result += bytes;
        } else {
            for (const char letter : bytes) {
                const auto byte = static_cast<unsigned char>(letter);
                result += {'\\', 'x', digits[byte >> 4U], digits[byte & 0xfU]};
            }
        }
        text.remove_prefix(bytes.size());
    }
    return result;
}

constexpr std::size_t letters_for_an_edit = 3;
constexpr std::size_t longest_word = 64;

std::string plain(std::string_view word) {
    std::string letters(word);
    for (char& letter : letters) {
        letter = letter == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    }
    return letters;
}

/// Returns the number of letters added, dropped, changed, or swapped with their neighbours (optimal string
/// alignment).
std::size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<std::vector<std::size_t>> edits(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) edits[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) edits[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t changed = edits[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            edits[i][j] = std::min({changed, edits[i - 1][j] + 1, edits[i][j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
            }
        }
    }
    return edits[a.size()][b.size()];
}

}  // namespace

std::string printable(std::string_view text) {
    return shown(text, false);
}

std::string printable_lines(std::string_view text) {
    return shown(text, true);
}

std::string nearest_word(std::string_view written, const std::vector<std::string>& words) {
    if (written.size() > longest_word) return {};
    const std::string meant = plain(written);
    std::string nearest;
    std::size_t fewest = 0;
    for (const std::string& word : words) {
        const std::size_t edits = edit_distance(meant, plain(word));
        if (edits > std::max<std::size_t>(1, word.size() / letters_for_an_edit) || edits >= word.size())
            continue;
        if (!nearest.empty() && edits >= fewest) continue;
        nearest = word;
        fewest = edits;
    }
    return nearest;
}

std::string did_you_mean(std::string_view written, const std::vector<std::string>& words) {
    const std::string nearest = nearest_word(written, words);
    return nearest.empty() ? std::string() : fmt::format("; did you mean '{}'?", nearest);
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const auto byte = [&](std::size_t i) {
        return i < bytes.size() ? std::uint32_t{static_cast<unsigned char>(bytes[i])} : 0U;
    };
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = bytes.size() - i;
        const std::uint32_t three = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
        text += letters[three >> 18U];
        text += letters[three >> 12U & 63U];
        text += left > 1 ? letters[three >> 6U & 63U] : '=';
        text += left > 2 ? letters[three & 63U] : '=';
    }
    return text;
}

}  // namespace samara
