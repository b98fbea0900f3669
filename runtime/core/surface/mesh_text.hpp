#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace samara {

/// Returns the text without the byte order mark of UTF-8 that some programs write. Throws Error, "LABEL:
/// ...", where it begins as UTF-16 or UTF-32.
std::string_view without_byte_order_mark(std::string_view text, const std::string& label);

/// Reads a number; false where the word is none. Too small a number is zero; "nan" and "inf" are numbers
/// here.
bool read_number(std::string_view word, double& number);

/// Returns the word in lower case.
std::string in_small_letters(std::string_view word);

/// The words of one line, from the left.
class Words {
  public:
    explicit Words(std::string_view line) : rest_(line) {}

    /// Takes the next word; empty after the last one.
    std::string_view next() {
        rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
        const std::string_view word = rest_.substr(0, rest_.find_first_of(blanks));
        rest_.remove_prefix(word.size());
        return word;
    }

    /// Returns the rest of the line that was not taken yet.
    [[nodiscard]] std::string_view rest() const { return rest_; }

    static constexpr std::string_view blanks = " \t\v\f";

  private:
    std::string_view rest_;
};

/// Calls `visit` with each line and its number, from 1. Lines end as on Unix, on Windows, or as on old Macs.
/// With `continued`, a line that ends in a backslash and the next are one, with the first number.
template <typename Visit>
void visit_lines(std::string_view text, bool continued, const Visit& visit) {
    std::string joined;
    int first = 0;  // the number of the first of the joined lines; 0: none
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(end);
        text.remove_prefix(text.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, text.size()));
        const std::string_view trimmed = line.substr(0, line.find_last_not_of(Words::blanks) + 1);
        if (continued && trimmed.ends_with('\\')) {
            if (first == 0) first = number;
            joined.append(trimmed.substr(0, trimmed.size() - 1)) += ' ';
            if (!text.empty()) continue;
            line = {};
        }
        if (first == 0) {
            visit(line, number);
        } else {
            visit(std::string_view(joined.append(line)), first);
            joined.clear();
            first = 0;
        }
    }
}

}  // namespace samara
