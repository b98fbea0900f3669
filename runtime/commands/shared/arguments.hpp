#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace samara {

/// The command line of one program: a thin layer over CLI11, which keeps its long compilation in one place.
/// Every program has --help, --version and --json. Values given here as references must outlive run_program.
class Arguments {
  public:
    Arguments(std::string program, std::string description);
    ~Arguments();
    Arguments(const Arguments&) = delete;
    Arguments& operator=(const Arguments&) = delete;

    /// Adds a required word, by its place.
    void positional(const std::string& name, std::string& value, const std::string& help);
    /// Adds a word by its place that may be left out: then the value stays as it is.
    void optional_positional(const std::string& name, std::string& value, const std::string& help);
    /// Adds one word or more, by their place.
    void positionals(const std::string& name, std::vector<std::string>& values, const std::string& help);
    /// Adds a flag without a value, such as "--keep".
    void flag(const std::string& name, bool& value, const std::string& help);
    /// Adds an option with a value, such as "-o,--output"; the default shown in the help is the value it has
    /// now. Numbers that do not parse, and values outside [lowest, highest], are rejected with the option's
    /// name.
    void option(const std::string& name, std::string& value, const std::string& help);
    /// Adds an option with a text that must be given.
    void required_option(const std::string& name, std::string& value, const std::string& help);
    /// Adds an option that names a file to write: run_program rejects one that cannot be written before the
    /// work.
    void output_option(const std::string& name, std::string& value, const std::string& help);
    /// Adds an output_option() that must be given.
    void required_output_option(const std::string& name, std::string& value, const std::string& help);
    void option(const std::string& name, double& value, const std::string& help, double lowest,
                double highest);
    void option(const std::string& name, int& value, const std::string& help, int lowest, int highest);
    void option(const std::string& name, std::optional<int>& value, const std::string& help, int lowest,
                int highest);
    void option(const std::string& name, std::optional<double>& value, const std::string& help, double lowest,
                double highest);
    void option(const std::string& name, std::uint64_t& value, const std::string& help);
    /// Adds an option whose value is one of the given words.
    void choice(const std::string& name, std::string& value, const std::vector<std::string>& words,
                const std::string& help);
    /// Sets the text under the options in --help: examples, the meaning of the output.
    void footer(const std::string& text);
    /// Returns whether the user gave the option.
    [[nodiscard]] bool given(const std::string& name) const;
    /// Returns whether --json was given: then the command prints nothing else on standard output.
    [[nodiscard]] bool json() const;

  private:
    friend int run_program(int argc, const char* const* argv, Arguments& arguments,
                           const std::function<nlohmann::json()>& body);
    struct Parser;
    std::unique_ptr<Parser> parser_;
};

/// Parses the words and runs `body`, which does the command's work, prints its text for people unless --json
/// was given, and returns its result, printed as one JSON object where --json was given, in ASCII: bytes of
/// names that are no UTF-8 become U+FFFD; for an error {"error": "what is wrong"} beside the line below. The
/// single word --list-options instead prints the options and the words they take, for a shell's completion.
/// Returns the exit status of run_guarded(): 0, or 1 after one line "PROGRAM: what is wrong" on standard
/// error, for bad words, where the option that was meant is named, as for an Error.
int run_program(int argc, const char* const* argv, Arguments& arguments,
                const std::function<nlohmann::json()>& body);

/// Runs the work of a program or command and returns its exit status: 0, or 1 after one line "PROGRAM: what
/// is wrong" on standard error for whatever the work throws, and where standard output did not take what was
/// printed. Before the work it prepares the process: standard streams that were closed are
/// opened, so that no file that is written gets their numbers, and a pipe without a reader or a file beyond
/// the limit of the shell is an error of the writing, which cleans up, not the end of the process. Programs
/// that are started get these signals as they were. With `as_json` what is wrong is on standard output too,
/// as {"error": "what is wrong"}, without the program's name.
int run_guarded(const std::string& program, const std::function<void()>& work, bool as_json = false);

/// Throws Error unless the name is one that a motion file may have, NAME.h5: for a name in another program's
/// format it says which command makes such a file from a motion file.
void require_motion_file_name(const std::string& output);

/// Returns the words between the commas of a list, without empty ones.
std::vector<std::string> comma_separated(const std::string& list);

}  // namespace samara
