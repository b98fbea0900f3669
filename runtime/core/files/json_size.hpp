#pragma once

#include <string>
#include <string_view>

namespace samara {

/// How many lists and objects of a JSON text may be open at once: readers work by recursion.
inline constexpr int most_json_depth = 100;

/// What is wrong with the size or the depth of a JSON text, or an empty text: whoever reads it stays within
/// 64 MB and most_json_depth.
std::string error_of_json_size(std::string_view text);

}  // namespace samara
