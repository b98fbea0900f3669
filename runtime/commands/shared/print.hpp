#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json_fwd.hpp>

namespace samara {

/// Prints a program's result on standard output, with printable_lines() of it, so that no name in it reaches
/// a terminal as a command. Throws Error where it cannot be written.
void print_result_text(std::string_view text);

/// Formats a program's result and prints it as print_result_text() does.
template <typename... Values>
void print_result(fmt::format_string<Values...> format, Values&&... values) {
    print_result_text(fmt::format(format, std::forward<Values>(values)...));
}

/// Prints a line of JSON in plain characters alone: a name in it that is no UTF-8, or a command to a
/// terminal, does no harm. Otherwise as print_result_text().
void print_json(const nlohmann::json& result);

/// Writes all that was printed to the end. Throws Error where it cannot be.
void flush_output();

/// Writes bytes as they are on standard error. What cannot be written, since it is closed or full, is lost:
/// notes and progress are no reason to fail.
void write_to_standard_error(std::string_view bytes) noexcept;

/// Prints a line on standard error, with its line feed, made printable as by print_result_text(); what cannot
/// be written is lost.
void print_note_text(std::string_view text);

/// Formats a line and prints it as print_note_text() does.
template <typename... Values>
void print_note(fmt::format_string<Values...> format, Values&&... values) {
    print_note_text(fmt::format(format, std::forward<Values>(values)...));
}

/// Progress on standard error: "baking: 4 of 15 cases, about 40 s left". On a terminal one line that is
/// rewritten; else a line every ten seconds, so that a log stays short. Nothing is printed for work that
/// takes less than a second.
class Progress {
  public:
    /// Starts the clock. `what`: the work, as in "baking"; `unit`: what is counted, as in "cases".
    Progress(const std::string& what, std::string unit);
    /// Clears a terminal's line.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Shows the work done and the whole work, in `unit`.
    void update(double done, double total);

  private:
    using Clock = std::chrono::steady_clock;

    std::string what_;
    std::string unit_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_ = start_;
    bool terminal_;
    bool printed_ = false;
};

}  // namespace samara
