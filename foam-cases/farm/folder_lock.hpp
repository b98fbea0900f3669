#pragma once

#include <filesystem>

namespace samara {

/// Holds a folder for one program at a time, by an advisory lock on the file .lock in it; the lock ends with
/// the object and with the program, however it ends.
class FolderLock {
  public:
    /// Makes the folder where it is not there. Throws Error where another program holds it.
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

  private:
    int descriptor_ = -1;
};

}  // namespace samara
