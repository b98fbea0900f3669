// Has libFuzzer change recipes by whole words: names of places in the seed, numbers at the edges of types.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "hdf5_recipe.hpp"

// NOLINTBEGIN(readability-identifier-naming): libFuzzer's names
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* bytes, std::size_t size, std::size_t most);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* bytes, std::size_t size, std::size_t most,
                                               unsigned int seed);
// NOLINTEND(readability-identifier-naming)

namespace samara::fuzz {
namespace {

using Words = std::vector<std::string>;

constexpr std::array<const char*, 13> verbs = {"delete", "rename", "link",   "external", "group",
                                               "type",   "shape",  "number", "number",   "fill",
                                               "text",   "chunk",  "chunk"};
constexpr std::array<const char*, 5> layouts = {"checked", "plain", "growing", "deflated", "edges"};
/// Of chunks: whole ones hold the values and 4 bytes.
constexpr std::array<const char*, 12> chunk_sizes = {"0",  "1",  "2",  "3",  "4",   "5",
                                                     "16", "24", "28", "72", "100", "4096"};
constexpr std::array<const char*, 13> types = {"f64", "f32",  "i8",    "u8",    "i32",      "u32",   "i64",
                                               "u64", "text", "vtext", "array", "compound", "opaque"};
constexpr std::array<const char*, 28> numbers = {
    "0",      "1",          "2",          "3",      "4",    "6",   "7",
    "9",      "-1",         "0.5",        "-2",     "1e-3", "1e3", "1e9",
    "1e30",   "1e160",      "1e300",      "-1e300", "nan",  "inf", "-inf",
    "5e-324", "2147483647", "4294967296", "1e-300", "12",   "80",  "18446744073709551615"};
constexpr std::array<const char*, 8> texts = {
    "finite",       "spherical", "0123456789abcdef0123456789abcdef", "{\"cases\": []}", "\x1b[2J", "=cmd",
    "<!--<script>", "../../x"};

class Mutation {
  public:
    Mutation(unsigned int seed, const SeedFile& file) : random_(seed), places_(file.places) {}

    [[nodiscard]] std::string changed(const std::string& recipe) {
        std::vector<std::string> lines;
        std::istringstream stream(recipe);
        for (std::string line; std::getline(stream, line);) lines.push_back(line);
        const std::size_t choice = below(8);
        if (lines.empty() || choice < 3) {
            lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(below(lines.size() + 1)), new_line());
        } else if (choice == 3) {
            lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(below(lines.size())));
        } else {
            std::string& line = lines[below(lines.size())];
            line = choice == 4 ? new_line() : with_other_word(line);
        }
        std::string result;
        for (const std::string& line : lines) result += line + '\n';
        return result;
    }

  private:
    std::size_t below(std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
    }

    template <typename List>
    std::string one_of(const List& list) {
        return list[below(list.size())];
    }

    std::string new_line() {
        const std::string verb = one_of(verbs);
        std::string line = verb + ' ' + one_of(places_);
        if (verb == "rename" || verb == "link") line += ' ' + one_of(places_);
        if (verb == "external") line += " other.h5 " + one_of(places_);
        if (verb == "type") line += ' ' + one_of(types);
        if (verb == "text") line += ' ' + one_of(texts);
        if (verb == "number") line += ' ' + std::to_string(below(40));
        if (verb == "number" || verb == "fill") line += ' ' + one_of(numbers);
        if (verb == "chunk") {
            line += ' ' + one_of(layouts) + ' ' + std::to_string(1 + below(8)) + ' ' + one_of(chunk_sizes);
            line += below(2) == 0 ? " 0" : " 1";
        }
        if (verb == "shape") {
            for (std::size_t i = below(5); i > 0; --i) line += ' ' + one_of(numbers);
        }
        return line;
    }

    /// The line with one word after the first changed for another of its kind.
    std::string with_other_word(const std::string& line) {
        Words words;
        std::istringstream stream(line);
        for (std::string word; stream >> word;) words.push_back(word);
        if (words.size() < 2) return new_line();
        const std::size_t at = 1 + below(words.size() - 1);
        std::string& word = words[at];
        if (word.starts_with('/')) {
            word = one_of(places_);
        } else if (words[0] == "type") {
            word = one_of(types);
        } else if (words[0] == "chunk") {
            word = at == 2 ? one_of(layouts) : one_of(chunk_sizes);
        } else {
            word = words[0] == "text" ? one_of(texts) : one_of(numbers);
        }
        std::string result;
        for (const std::string& each : words) result += (result.empty() ? "" : " ") + each;
        return result;
    }

    std::minstd_rand random_;
    const std::vector<std::string>& places_;
};

}  // namespace
}  // namespace samara::fuzz

std::size_t LLVMFuzzerCustomMutator(std::uint8_t* bytes, std::size_t size, std::size_t most,
                                    unsigned int seed) {
    if (seed % 16 == 0) return LLVMFuzzerMutate(bytes, size, most);
    samara::fuzz::Mutation mutation(seed, samara::fuzz::seed_file());
    const std::string recipe = mutation.changed({reinterpret_cast<const char*>(bytes), size});
    const std::size_t length = std::min(recipe.size(), most);
    std::copy_n(recipe.data(), length, bytes);
    return length;
}
