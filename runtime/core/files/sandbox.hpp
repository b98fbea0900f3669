#pragma once

#include <filesystem>
#include <vector>

namespace samara {

/// Takes the calling process, which must have one thread, the right to do anything but compute and read, for
/// good: a system call that starts a program or a process ends it with SIGSYS; opening a file to write,
/// making, renaming and removing files, the network, signals to other processes, and what could have a file
/// send them fail with EPERM. Files
/// that are open already can be written on; threads can be started. Where the kernel has Landlock (Linux
/// 5.13), nothing is read but what lies beneath `readable`, the system's libraries and /proc/self. Throws
/// Error where the kernel offers no seccomp filter.
void enter_sandbox(const std::vector<std::filesystem::path>& readable);

}  // namespace samara
