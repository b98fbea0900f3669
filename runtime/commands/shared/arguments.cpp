#include "samara/commands/shared/arguments.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "samara/commands/shared/print.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/base/text.hpp"
#include "samara/core/base/version.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/replace_file.hpp"
#include "samara/motion/file_check.hpp"

namespace samara {
namespace {

/// Reads of standard input find an end, and writes to standard output fail, as with the closed streams.
void open_closed_streams() {
    constexpr int as_closed[] = {O_RDONLY, O_RDONLY, O_WRONLY};
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
        // The lowest number that is free is given: this one, since those below are open.
        if (::fcntl(stream, F_GETFD) < 0) (void)::open("/dev/null", as_closed[stream]);
    }
}

/// Makes a signal an error of the call that causes it. By a handler rather than SIG_IGN, since programs that
/// are started would inherit that.
void make_errors_of(int signal) {
    struct sigaction action = {};
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) return;
    action.sa_handler = [](int) {};
    action.sa_flags = SA_RESTART;
    ::sigaction(signal, &action, nullptr);
}

std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.pop_back();
    return text;
}

/// Returns an exception's message as one line with a remedy where it is known.
std::string error_of(const std::exception& error) {
    if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) {
        return "out of memory; use fewer triangles, bodies, frames or runs";
    }
    if (dynamic_cast<const std::length_error*>(&error) != nullptr) {
        return "the request needs more memory than any machine has; check counts and units";
    }
    if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error)) {
        return fmt::format("{}: cannot be used: {}", file->path1().string(), file->code().message());
    }
    return one_line(error.what());
}

/// Prints an error as JSON on standard output; silent where that cannot be written, since standard error has
/// it too.
void print_as_json(const std::string& error) noexcept {
    try {
        print_json({{"error", error}});
        flush_output();
    } catch (const std::exception&) {
        return;
    }
}

struct MadeFromMotion {
    std::string_view ending;
    std::string_view command;
};

constexpr std::array<MadeFromMotion, 7> others = {{{".glb", "export"},
                                                   {".usda", "export"},
                                                   {".chan", "export"},
                                                   {".html", "export"},
                                                   {".csv", "export"},
                                                   {".png", "plot"},
                                                   {".svg", "plot"}}};

}  // namespace

struct Arguments::Parser {
    CLI::App app;
    std::string program;
    bool json = false;
    std::map<std::string, std::vector<std::string>> choices;  ///< words of each option, by its name with its
                                                              ///< dashes
    std::vector<const std::string*> outputs;                  ///< files to write; empty where none is given
};

namespace {

constexpr std::string_view json_option = "--json";

/// Prints for shells a line for each option: its names and, after a tab, the words that it takes.
void list_options(const CLI::App& app, const std::map<std::string, std::vector<std::string>>& choices) {
    for (const CLI::Option* option : app.get_options()) {
        std::vector<std::string> names;
        for (const std::string& name : option->get_snames()) names.push_back('-' + name);
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
        if (names.empty()) continue;  // a word by its place
        const auto words = choices.find(option->get_name());
        print_result("{}\t{}\n", fmt::join(names, " "),
                     words == choices.end() ? "" : fmt::format("{}", fmt::join(words->second, " ")));
    }
}

std::vector<std::string> options_of(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back(fmt::format("--{}", name));
    }
    return names;
}

/// Returns what is wrong with the words: first an unknown option, since the option that was meant may then be
/// missing.
std::string error_in_words(const CLI::App& app, const CLI::ParseError& error) {
    const std::string see_help = fmt::format("; see '{} --help'", app.get_name());
    const std::vector<std::string> unknown = app.remaining();
    for (const std::string& word : unknown) {
        if (word.size() < 2 || word.front() != '-' || word == "--") continue;
        const std::string option = word.substr(0, word.find('='));
        const std::string meant = did_you_mean(option, options_of(app));
        return fmt::format("unknown option '{}'{}", option, meant.empty() ? see_help : meant);
    }
    const bool too_many = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
    return (too_many && !unknown.empty()
                ? fmt::format("unexpected argument '{}'; leave it out", unknown.front())
                : std::string(error.what())) +
           see_help;
}

/// Rejects "3mm" and "fast" where a number is due.
const CLI::Validator plain_number(
    [](const std::string& word) {
        double number = 0.0;
        if (CLI::detail::lexical_cast(word, number)) return std::string();
        return fmt::format("'{}' is not a number; give a number without a unit, in SI units: m, kg, s, rad",
                           word);
    },
    "");

/// Returns whether the words ask for JSON, whatever else is wrong with them.
bool asks_for_json(int argc, const char* const* argv) {
    return std::any_of(argv, argv + argc, [](const char* word) { return word == json_option; });
}

}  // namespace

Arguments::Arguments(std::string program, std::string description) : parser_(std::make_unique<Parser>()) {
    parser_->app.description(std::move(description));
    parser_->app.name(program);
    parser_->program = std::move(program);
    parser_->app.get_formatter()->column_width(34);
    parser_->app.set_version_flag("--version", std::string("samara ") + version);
    parser_->app.add_flag(std::string(json_option), parser_->json,
                          "print the result as one JSON object; an error as {\"error\": \"...\"}");
}

Arguments::~Arguments() = default;

void Arguments::positional(const std::string& name, std::string& value, const std::string& help) {
    parser_->app.add_option(name, value, help)->required();
}

void Arguments::optional_positional(const std::string& name, std::string& value, const std::string& help) {
    parser_->app.add_option(name, value, help);
}

void Arguments::positionals(const std::string& name, std::vector<std::string>& values,
                            const std::string& help) {
    parser_->app.add_option(name, values, help)->required();
}

void Arguments::flag(const std::string& name, bool& value, const std::string& help) {
    parser_->app.add_flag(name, value, help);
}

void Arguments::option(const std::string& name, std::string& value, const std::string& help) {
    auto* option = parser_->app.add_option(name, value, help);
    if (!value.empty()) option->capture_default_str();
}

void Arguments::required_option(const std::string& name, std::string& value, const std::string& help) {
    parser_->app.add_option(name, value, help)->required();
}

void Arguments::output_option(const std::string& name, std::string& value, const std::string& help) {
    option(name, value, help);
    parser_->outputs.push_back(&value);
}

void Arguments::required_output_option(const std::string& name, std::string& value, const std::string& help) {
    required_option(name, value, help);
    parser_->outputs.push_back(&value);
}

void Arguments::option(const std::string& name, double& value, const std::string& help, double lowest,
                       double highest) {
    parser_->app.add_option(name, value, help)
        ->check(plain_number)
        ->check(CLI::Range(lowest, highest))
        ->capture_default_str();
}

void Arguments::option(const std::string& name, int& value, const std::string& help, int lowest,
                       int highest) {
    parser_->app.add_option(name, value, help)
        ->check(plain_number)
        ->check(CLI::Range(lowest, highest))
        ->capture_default_str();
}

void Arguments::option(const std::string& name, std::optional<int>& value, const std::string& help,
                       int lowest, int highest) {
    parser_->app.add_option(name, value, help)->check(plain_number)->check(CLI::Range(lowest, highest));
}

void Arguments::option(const std::string& name, std::optional<double>& value, const std::string& help,
                       double lowest, double highest) {
    parser_->app.add_option(name, value, help)->check(plain_number)->check(CLI::Range(lowest, highest));
}

void Arguments::option(const std::string& name, std::uint64_t& value, const std::string& help) {
    parser_->app.add_option(name, value, help)->capture_default_str();
}

void Arguments::choice(const std::string& name, std::string& value, const std::vector<std::string>& words,
                       const std::string& help) {
    CLI::Option* option = parser_->app.add_option(name, value, help);
    option->check(CLI::IsMember(words))->capture_default_str();
    parser_->choices[option->get_name()] = words;
}

void Arguments::footer(const std::string& text) {
    parser_->app.footer(text);
}

bool Arguments::given(const std::string& name) const {
    return parser_->app.count(name) > 0;
}

bool Arguments::json() const {
    return parser_->json;
}

int run_program(int argc, const char* const* argv, Arguments& arguments,
                const std::function<nlohmann::json()>& body) {
    Arguments::Parser& parser = *arguments.parser_;
    const auto work = [&] {
        if (argc == 2 && std::string_view(argv[1]) == "--list-options") {
            list_options(parser.app, parser.choices);
            return;
        }
        try {
            parser.app.parse(argc, argv);
        } catch (const CLI::Success& asked_for_help) {
            std::ostringstream help;
            parser.app.exit(asked_for_help, help, help);
            print_result("{}", help.str());
            return;
        } catch (const CLI::ParseError& error) {
            throw std::runtime_error(error_in_words(parser.app, error));
        }
        for (const std::string* output : parser.outputs) {
            if (!output->empty()) require_writable(*output);
        }
        const CheckBeforeReading check;
        const nlohmann::json result = body();
        if (parser.json) print_json(result);
    };
    return run_guarded(parser.program, work, asks_for_json(argc, argv));
}

int run_guarded(const std::string& program, const std::function<void()>& work, bool as_json) {
    open_closed_streams();
    make_errors_of(SIGPIPE);
    make_errors_of(SIGXFSZ);
    try {
        work();
        flush_output();
        return 0;
    } catch (const std::exception& error) {
        const std::string text = error_of(error);
        std::fflush(stdout);
        if (as_json) print_as_json(text);
        print_note("{}: {}\n", program, text);
        return 1;
    }
}

void require_motion_file_name(const std::string& output) {
    const std::filesystem::path file = output;
    const std::string ending = file.extension().string();
    for (const MadeFromMotion& other : others) {
        if (ending != other.ending) continue;
        const std::string motion = std::filesystem::path(file).replace_extension(".h5").string();
        throw Error(fmt::format("{}: the output is a motion file; write {}, then 'samara {} {} -o {}'",
                                output, motion, other.command, motion, output));
    }
    if (is_body_file_name(file)) {
        throw Error(fmt::format("{}: is the name of a body file; name the motion file NAME.h5", output));
    }
    if (ending != ".h5") throw Error(fmt::format("{}: the name of a motion file ends in .h5", output));
}

std::vector<std::string> comma_separated(const std::string& list) {
    std::vector<std::string> words;
    std::istringstream stream(list);
    for (std::string word; std::getline(stream, word, ',');) {
        if (!word.empty()) words.push_back(word);
    }
    return words;
}

}  // namespace samara
