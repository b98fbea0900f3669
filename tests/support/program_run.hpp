#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "support/temporary_folder.hpp"

namespace samara::test {

/// The result of a program.
struct ProgramRun {
    int status = 0;
    std::string output;  ///< standard output
    std::string error;   ///< standard error
    [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(output); }
};

/// Runs one of the project's programs (the first word, such as "samara") in the folder, to its end.
/// `environment`: assignments before the command, as a shell takes them.
ProgramRun run_program_in(const TemporaryFolder& folder, const std::vector<std::string>& words,
                          const std::string& environment = "");

/// Returns whether the text is one line that ends with a line break, as every error message must be.
bool is_one_line(const std::string& text);

}  // namespace samara::test
