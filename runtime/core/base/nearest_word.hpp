#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace samara {

/// Which of the words was meant by one that is none of them: the nearest, where a letter that is missing, too
/// many, wrong or swapped with its neighbour, in every three of them, makes the one of the other; capitals
/// and '-' for '_' do not count. Empty where none is near.
std::string nearest_word(std::string_view written, const std::vector<std::string>& words);

/// "; did you mean 'WORD'?" for nearest_word(), or empty.
std::string did_you_mean(std::string_view written, const std::vector<std::string>& words);

}  // namespace samara
