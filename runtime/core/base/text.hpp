#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace samara {

/// A text that a terminal shows and does not obey, in valid UTF-8 and on one line: bytes that are no UTF-8,
/// control characters, line breaks among them, and characters that turn the direction of writing become \xNN,
/// byte by byte. All else stays, so that a text made printable twice is the same.
std::string printable(std::string_view text);

/// The same, but line feeds and tabs stay.
std::string printable_lines(std::string_view text);

/// Which of the words was meant by one that is none of them: the nearest, where a letter that is missing, too
/// many, wrong or swapped with its neighbour, in every three of them, makes the one of the other; capitals
/// and '-' for '_' do not count. Empty where none is near.
std::string nearest_word(std::string_view written, const std::vector<std::string>& words);

/// "; did you mean 'WORD'?" for nearest_word(), or empty.
std::string did_you_mean(std::string_view written, const std::vector<std::string>& words);

/// Whether a name of a body or an obstacle can stand in files of all kinds: letters, digits, '-' and '_', 64
/// at most.
inline bool is_plain_name(std::string_view name) {
    constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    return !name.empty() && name.size() <= 64 && name.find_first_not_of(allowed) == std::string_view::npos;
}

/// Base64 of RFC 4648, padded.
std::string base64(std::string_view bytes);

}  // namespace samara
