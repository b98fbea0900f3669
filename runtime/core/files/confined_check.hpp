#pragma once

#include <functional>
#include <string>

#include "samara/core/files/input_file.hpp"

namespace samara {

/// Runs `read`, which reads all of the file, in a process of its own that can do nothing else (run_confined),
/// so that nothing that the file holds can harm this one, and returns what it returned. Throws Error where
/// `read` throws one, where it crashes, hangs or takes too much memory, and where the system offers no such
/// process.
std::string check_confined(const InputFile& input, const std::function<std::string()>& read);

/// Whether the system offers such processes.
bool offers_confinement();

}  // namespace samara
