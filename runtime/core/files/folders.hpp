#pragma once

#include <filesystem>

namespace samara {

/// A new folder for passing files to other programs, removed with all it holds at the end. Those of programs
/// that were killed are removed when the next is made.
class TemporaryFolder {
  public:
    /// Throws Error where the system's folder for temporary files takes none.
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::filesystem::path operator/(const std::filesystem::path& name) const {
        return path_ / name;
    }

  private:
    std::filesystem::path path_;
    int lock_ = -1;  ///< held while it is in use: the system lets go when a program is killed
};

/// Files that samara brings along.
struct ShareFolder {
    const char* name;      ///< below share/samara: "bodies"
    const char* contents;  ///< in words, plural, for errors
    const char* variable;  ///< of the environment: names another folder
    const char* mark;      ///< what the folder must hold; empty: nothing in particular
    const char* source;    ///< where it is in this source tree
};

/// Where such files are: in the folder that the environment's variable names, or ../share/samara/NAME beside
/// the running program's folder, or NAME beside the library that holds samara (a Python wheel), or in this
/// source tree. Throws Error where the variable names no such
/// folder, and where none of the others is one.
std::filesystem::path find_share_folder(const ShareFolder& share);

}  // namespace samara
