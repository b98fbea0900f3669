#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace samara {

/// Runs a program with the given words, and its child processes, in a process group that never outlives this
/// program: where this program ends, even by SIGKILL, the whole group is killed. Its output goes to the file
/// `output`, its working folder is `folder`. `tick` is called ten times a second meanwhile.
///
/// Returns the exit status (128 + the number of the signal that ended it), or nothing where the user
/// interrupted this program (SIGINT, SIGTERM): then the group has been killed. Throws Error where it cannot
/// be started.
std::optional<int> run_guarded(const std::vector<std::string>& words, const std::filesystem::path& output,
                               const std::filesystem::path& folder, const std::function<void()>& tick);

/// Locks a folder for one program at a time, by an advisory lock on the file .lock in it, which ends with the
/// object or the program.
class FolderLock {
  public:
    /// Creates the folder where it does not exist. Throws Error where another program has locked it.
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

  private:
    int descriptor_ = -1;
};

}  // namespace samara
