#pragma once

#include <string>
#include <string_view>

namespace samara {

/// A text that a terminal shows and does not obey, in valid UTF-8 and on one line: bytes that are no UTF-8,
/// control characters, line breaks among them, and characters that turn the direction of writing become \xNN,
/// byte by byte. All else stays, so that a text made printable twice is the same.
std::string printable(std::string_view text);

/// The same, but line feeds and tabs stay.
std::string printable_lines(std::string_view text);

}  // namespace samara
