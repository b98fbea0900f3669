// The program `samara`: runs one of its own commands, or the program samara-COMMAND.

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "commands/commands.hpp"
#include "samara/base/version.hpp"
#include "samara/command/subprocess.hpp"

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
    {"plan", "scene -> the cases that it needs, and their cost", nullptr},
    {"bake", "OpenFOAM cases around a body -> load and turbulence tables", nullptr},
    {"convert", "solved cases -> tables in the body file", nullptr},
    {"identify", "solved free falls -> dynamic coefficients in the body file", nullptr},
    {"check-tables", "tables against solved cases that they were not made from", nullptr},
    {"bodies", "the ready-baked bodies that come with it", samara::bodies_command},
    {"simulate", "scene -> motion of its bodies", samara::simulate_command},
    {"export", "motion -> .glb, .usda, .chan for animation tools, .html, .csv", samara::export_command},
    {"plot", "motion -> picture: silhouettes along the path, time series", samara::plot_command},
    {"compare", "motion held against another, such as a fall by full CFD", samara::compare_command},
    {"validate", "scene -> the same motion by full CFD, to hold the runtime against", nullptr},
    {"info", "what a file holds, its units and its provenance", samara::info_command},
};

bool is_installed(const Command& command) {
    return command.run != nullptr || samara::find_program(fmt::format("samara-{}", command.name)).has_value();
}

void print_help() {
    fmt::print(
        "samara: rigid bodies that fall, flutter and tumble through water or air\n\n"
        "Usage: samara COMMAND [options]; 'samara COMMAND --help' tells more\n\n");
    for (const Command& command : commands) {
        fmt::print("  {:<13}{}{}\n", command.name, command.does,
                   is_installed(command) ? "" : " (not installed)");
    }
}

/// For a shell's completion.
void list_commands() {
    for (const Command& command : commands) {
        if (is_installed(command)) fmt::print("{}\n", command.name);
    }
}

int run_other_program(const std::string& name, int argc, char** argv) {
    const auto program = samara::find_program("samara-" + name);
    if (!program) {
        for (const Command& command : commands) {
            if (command.name == name) {
                fmt::print(stderr,
                           "samara: the program samara-{} is not installed; it belongs to the baking tools "
                           "(build with SAMARA_BAKING=ON)\n",
                           name);
                return 1;
            }
        }
        fmt::print(stderr, "samara: there is no command '{}'; see 'samara --help'\n", name);
        return 1;
    }
    std::vector<char*> words(argv + 1, argv + argc);
    words.push_back(nullptr);
    ::execv(program->c_str(), words.data());
    fmt::print(stderr, "samara: {} cannot be started\n", program->string());
    return 1;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string name = argc > 1 ? argv[1] : "--help";
    if (name == "--help" || name == "-h" || name == "help") {
        print_help();
        return 0;
    }
    if (name == "--list-commands") {
        list_commands();
        return 0;
    }
    if (name == "--version") {
        fmt::print("samara {}\n", samara::version);
        return 0;
    }
    for (const Command& command : commands) {
        if (command.name == name && command.run != nullptr) return command.run(argc - 1, argv + 1);
    }
    return run_other_program(name, argc, argv);
}
