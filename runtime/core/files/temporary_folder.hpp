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

}  // namespace samara
