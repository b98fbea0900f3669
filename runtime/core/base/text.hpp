#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace samara {

/// Returns a text that a terminal shows and does not obey, in valid UTF-8 and on one line. Bytes that are no
/// UTF-8, control characters, line breaks among them, and characters that change the direction of writing
/// become \xNN, byte by byte. All else stays, so that a text made printable twice is the same.
std::string printable(std::string_view text);

/// Returns printable(text) with line feeds and tabs kept.
std::string printable_lines(std::string_view text);

/// Returns the word nearest to a misspelt one. It is near where one letter missing, added, wrong or swapped
/// with its neighbour, for every three of its letters, makes one of the other; case is ignored, and '-'
/// equals '_'. Empty where none is near.
std::string nearest_word(std::string_view written, const std::vector<std::string>& words);

/// Returns "; did you mean 'WORD'?" with nearest_word(), or an empty text.
std::string did_you_mean(std::string_view written, const std::vector<std::string>& words);

/// What a name that is not plain breaks, in words to stand behind "name".
inline constexpr std::string_view plain_name_words =
    "may contain only letters, digits, '-' and '_', 64 at most";

/// Returns whether a name of a body or an obstacle may stand in files of all formats: letters, digits, '-'
/// and '_', 64 at most.
inline bool is_plain_name(std::string_view name) {
    constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    return !name.empty() && name.size() <= 64 && name.find_first_not_of(allowed) == std::string_view::npos;
}

/// Returns the bytes in base64 (RFC 4648), padded.
std::string base64(std::string_view bytes);

}  // namespace samara
