#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "samara/core/files/input_file.hpp"

namespace samara {

/// What a confined process may use.
struct ConfinedLimits {
    std::vector<std::filesystem::path> readable;         ///< folders, with all beneath them
    double cpu_seconds = 300.0;                          ///< of all its threads together
    double idle_seconds = 60.0;                          ///< waiting, for a pipe say, without computing
    double memory = 0.75;                                ///< over that of the machine
    std::uint64_t sent_bytes = std::uint64_t{1} << 30U;  ///< of all that it sends
};

/// Sends bytes from the confined process to the one that waits for it.
using SendBytes = std::function<void(std::string_view bytes)>;

/// Reads what is not trusted: runs `work` in a child process of the calling one, in a sandbox (enter_sandbox)
/// and within the limits, and waits for it. Whatever `work` does, it cannot start a program, change a file or
/// take this process down. Its standard streams lead nowhere. `receive` is called here with each text that
/// `work` sends, whole and in order: judge it, since it is no more trusted than what `work` reads. Throws
/// Error, one line that begins with `label`, where `work` crashed, left the process, wanted more than its
/// limits or to start a program; an Error of `work` itself passes on, its first line. No more than 1 ms is
/// lost.
void run_confined(const std::string& label, const ConfinedLimits& limits,
                  const std::function<void(const SendBytes& send)>& work,
                  const std::function<void(std::string_view bytes)>& receive);

/// Runs `read`, which reads all of the file, in a process of its own that can do nothing else (run_confined),
/// so that nothing that the file holds can harm this one, and returns what it returned. Throws Error where
/// `read` throws one, where it crashes, hangs or takes too much memory, and where the system offers no such
/// process.
std::string check_confined(const InputFile& input, const std::function<std::string()>& read);

/// Whether the system offers such processes.
bool offers_confinement();

}  // namespace samara
