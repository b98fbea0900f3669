#include "samara/core/base/nearest_word.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>

#include <fmt/format.h>

namespace samara {
namespace {

constexpr std::size_t letters_for_an_edit = 3;
constexpr std::size_t longest_word = 64;

std::string plain(std::string_view word) {
    std::string letters(word);
    for (char& letter : letters) {
        letter = letter == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    }
    return letters;
}

/// Letters added, dropped, changed, or swapped with their neighbours (optimal string alignment).
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

}  // namespace samara
