#pragma once

#include <filesystem>
#include <vector>

namespace samara {

/// Removes from the calling process, which must have one thread, all rights but to compute and read, for
/// good. A system call that starts a program or a process ends it with SIGSYS. Opening a file to write,
/// making, renaming and removing files, the network, signals to other processes, and calls that could make a
/// file send them, fail with EPERM. Files that are open already can be written on; threads can be started.
/// Where the kernel has Landlock (Linux 5.13), only what lies beneath `readable`, the system's libraries and
/// /proc/self can be read. Throws Error where the kernel offers no seccomp filter.
void enter_sandbox(const std::vector<std::filesystem::path>& readable);

}  // namespace samara
