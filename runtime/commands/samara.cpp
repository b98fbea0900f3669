// The program `samara`: runs the program samara-COMMAND, or one of its own commands.

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "samara/commands/commands.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/base/text.hpp"
#include "samara/core/base/version.hpp"

namespace hwy::platform {
/// Stands in for that of libhwy.so, which measures a clock for 3 ms whenever it is loaded; benchmarks alone
/// read it.
std::uint64_t TimerResolution();   // NOLINT(readability-identifier-naming): the library's name
std::uint64_t TimerResolution() {  // NOLINT(readability-identifier-naming)
    return 0;
}
}  // namespace hwy::platform

namespace {

struct Command {
    std::string_view name;
    std::string_view does;
    int (*run)(int argc, const char* const* argv);  // null: a program of its own
};

constexpr Command commands[] = {
    {"mesh", "shape file -> checked surface, volume moments, symmetry", nullptr},
    {"kirchhoff", "body or shape -> added mass (Kirchhoff tensor) in an unbounded fluid",
     samara::kirchhoff_command},
    {"mass", "sets the default mass in a body file", samara::mass_command},
    {"recommend", "sets the default models in a body file, as given or judged by a fall",
     samara::recommend_command},
    {"plan", "scene -> the CFD cases it needs, and their cost", nullptr},
    {"bake", "OpenFOAM cases around a body -> load and turbulence tables", nullptr},
    {"convert", "solved cases -> tables in the body file", nullptr},
    {"identify", "solved free falls -> dynamic coefficients in the body file", nullptr},
    {"check-tables", "compares tables with held-out solved cases", nullptr},
    {"wind", "velocity grids of OpenVDB -> wind file, for a scene's [wind.file]", nullptr},
    {"bodies", "lists the ready-baked bodies", samara::bodies_command},
    {"simulate", "scene -> motion of its bodies", samara::simulate_command},
    {"search", "scene -> seeds and launches with which a body lands as it shall", samara::search_command},
    {"export", "motion -> .glb, .usda, .chan for animation tools, .html, .csv", samara::export_command},
    {"plot", "motion or body -> picture: silhouettes, time series; polars, maps", samara::plot_command},
    {"compare", "compares a motion with a reference, such as a fall by full CFD", samara::compare_command},
    {"validate", "scene -> reference motion by full CFD", nullptr},
    {"report", "bake -> HTML page that judges its accuracy", samara::report_command},
    {"info", "prints a file's content, units and provenance", samara::info_command},
    {"check", "validates a file in a sandbox", samara::check_command},
};

bool is_installed(const Command& command) {
    return command.run != nullptr || samara::find_program(fmt::format("samara-{}", command.name)).has_value();
}

/// Returns whether the baking tools hold a version of the command that does more.
bool has_fuller_program(const Command& command) {
    return command.name == "report" && samara::find_program("samara-report").has_value();
}

void print_help() {
    samara::print_result(
        "samara: rigid bodies that fall, flutter and tumble through water or air\n\n"
        "Usage: samara COMMAND [options]; 'samara COMMAND --help' prints the options of a command\n\n");
    for (const Command& command : commands) {
        samara::print_result("  {:<13}{}{}\n", command.name, command.does,
                             is_installed(command) ? "" : " (not installed)");
    }
}

/// Prints the names of the commands for a shell's completion.
void list_commands() {
    for (const Command& command : commands) {
        if (is_installed(command)) samara::print_result("{}\n", command.name);
    }
}

/// Becomes the program; returns only by throwing.
void run_other_program(const std::string& name, char** argv) {
    const auto program = samara::find_program("samara-" + name);
    if (!program) {
        for (const Command& command : commands) {
            if (command.name != name) continue;
            throw samara::Error(
                fmt::format("the program samara-{} is not installed; install the package samara-baking, or "
                            "build with SAMARA_BAKING=ON",
                            name));
        }
        std::vector<std::string> names;
        for (const Command& command : commands) names.emplace_back(command.name);
        const std::string meant = samara::did_you_mean(name, names);
        throw samara::Error(
            fmt::format("unknown command '{}'{}", name, meant.empty() ? "; see 'samara --help'" : meant));
    }
    ::execv(program->c_str(), argv + 1);
    throw samara::Error(fmt::format("{}: cannot be started: {}", program->string(), std::strerror(errno)));
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): commands catch their own
int main(int argc, char** argv) {
    const std::string name = argc > 1 ? argv[1] : "--help";
    for (const Command& command : commands) {
        if (command.name != name || command.run == nullptr || has_fuller_program(command)) continue;
        return command.run(argc - 1, argv + 1);
    }
    const bool as_json =
        std::any_of(argv, argv + argc, [](std::string_view word) { return word == "--json"; });
    const auto work = [&] {
        if (name == "--help" || name == "-h" || name == "help") return print_help();
        if (name == "--list-commands") return list_commands();
        if (name == "--version") return samara::print_result("samara {}\n", samara::version);
        run_other_program(name, argv);
    };
    return samara::run_guarded("samara", work, as_json);
}
