#include "samara/core/base/printable.hpp"

#include <cstddef>
#include <cstdint>

namespace samara {
namespace {

/// A character in UTF-8: how many bytes it takes, 0 where there is none, and its number.
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
    constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800,
                                       0x10000};  // what fewer bytes say is not said by more
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

}  // namespace

std::string printable(std::string_view text) {
    return shown(text, false);
}

std::string printable_lines(std::string_view text) {
    return shown(text, true);
}

}  // namespace samara
