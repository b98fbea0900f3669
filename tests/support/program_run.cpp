#include "support/program_run.hpp"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/files/content_hash.hpp"

namespace samara::test {
namespace {

/// Before any test: what it meshes stays out of the user's cache, and is meshed each time.
[[maybe_unused]] const int cache_is_off = ::setenv("SAMARA_CACHE", "off", 1);

}  // namespace

ProgramRun run_program_in(const TemporaryFolder& folder, const std::vector<std::string>& words,
                          const std::string& environment) {
    std::string command = fmt::format("cd '{}' && {} '{}/{}'", folder.path().string(), environment,
                                      SAMARA_PROGRAMS, words.front());
    for (std::size_t i = 1; i < words.size(); ++i) command += fmt::format(" '{}'", words[i]);
    command += " > .output 2> .fault";
    const int status = run_subprocess({"/bin/sh", "-c", command});
    return {status, read_bytes(folder / ".output"), read_bytes(folder / ".fault")};
}

bool is_one_line(const std::string& text) {
    return !text.empty() && text.back() == '\n' && std::count(text.begin(), text.end(), '\n') == 1;
}

}  // namespace samara::test
