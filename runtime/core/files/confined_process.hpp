#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "samara/core/files/input_file.hpp"

namespace samara {

/// The limits of a confined process.
struct ConfinedLimits {
    std::vector<std::filesystem::path> readable;  ///< folders that it may read, with all beneath them
    double cpu_seconds = 300.0;                   ///< CPU time of all its threads together
    double idle_seconds = 60.0;                   ///< time of waiting, such as for a pipe, without computing
    double memory = 0.75;                         ///< relative to the machine's memory
    std::uint64_t sent_bytes = std::uint64_t{1} << 30U;  ///< the most that it may send in all
};

/// Sends bytes from the confined process to the one that waits for it.
using SendBytes = std::function<void(std::string_view bytes)>;

/// Runs `work`, which reads data that is not trusted, in a child process of the calling one, in a sandbox
/// (enter_sandbox) and within the limits, and waits for it. Whatever `work` does, it cannot start a program,
/// change a file or end this process. Its standard streams lead nowhere. `receive` is called here with each
/// text that `work` sends, whole and in order; these are no more trusted than the data itself. Throws Error,
/// one line that begins with `label`, where `work` crashed, left the process, exceeded its limits or tried to
/// start a program; the first line of an Error of `work` itself passes on. It costs less than 1 ms.
void run_confined(const std::string& label, const ConfinedLimits& limits,
                  const std::function<void(const SendBytes& send)>& work,
                  const std::function<void(std::string_view bytes)>& receive);

/// Runs `read`, which reads all of the file, in a process confined by run_confined(), so that the file's
/// content cannot harm this one, and returns its result. Throws Error where `read` throws one, where it
/// crashes, hangs or takes too much memory, and where the system offers no such process.
std::string check_confined(const InputFile& input, const std::function<std::string()>& read);

/// Returns whether the system offers processes that are confined by a filter of system calls.
bool offers_confinement();

}  // namespace samara
