#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace samara {

/// Returns the program `name` beside the running one, or else on PATH; nothing where it is not installed.
std::optional<std::filesystem::path> find_program(const std::string& name);

/// Runs a program to its end with the given words (the first is the program) and returns its exit status; 128
/// + the signal where one ended it. Standard streams are shared with it; where `output` is given, what it
/// writes on standard output and standard error goes to that file instead. Throws Error where it cannot be
/// started.
int run_subprocess(const std::vector<std::string>& words, const std::filesystem::path& output = {},
                   const std::filesystem::path& folder = {});

}  // namespace samara
