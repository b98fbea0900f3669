#pragma once

#include <filesystem>

namespace samara {

/// A new folder for passing files to other programs, removed with its content at the end. Folders of killed
/// programs are removed when the next one is made.
class TemporaryFolder {
  public:
    /// Throws Error where the system's folder for temporary files cannot hold one.
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
    int lock_ = -1;  ///< held while it is in use: the system releases it when a program is killed
};

/// A folder of files that samara is installed with.
struct ShareFolder {
    const char* name;      ///< below share/samara: "bodies"
    const char* contents;  ///< in words, plural, for errors
    const char* variable;  ///< of the environment: names another folder
    const char* mark;      ///< what the folder must hold; empty: nothing in particular
    const char* source;    ///< its place in this source tree
};

/// Returns the folder of such files: the one that the environment's variable names, or ../share/samara/NAME
/// beside the running program's folder, or NAME beside the library that holds samara (a Python wheel), or the
/// one in this source tree. Throws Error where the variable names no such folder, and where none of the
/// others is one.
std::filesystem::path find_share_folder(const ShareFolder& share);

}  // namespace samara
