#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace samara {

/// What keeps a path from being read as a file, for a message behind its name: "there is no such file", "is a
/// folder; give a file", "cannot be read: Permission denied"; empty where nothing does. Pipes and devices are
/// files here. Never throws for any path.
std::string reading_fault(const std::filesystem::path& path);

/// A file's bytes. Throws Error, "PATH: reading_fault()", where it cannot be read, and where it holds more
/// than `most`, which devices without an end do.
std::string read_at_most(const std::filesystem::path& path, std::size_t most);

/// A regular file that is open for reading as long as this lives.
class InputFile {
  public:
    /// Throws Error, "PATH: reading_fault()", and where it is no regular file: nothing waits for the other
    /// end of a pipe.
    explicit InputFile(const std::filesystem::path& path);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] int descriptor() const { return descriptor_; }
    [[nodiscard]] std::uint64_t size() const { return size_; }  ///< bytes, when it was opened
    /// A name for libraries that open files themselves: of this very file, whatever has come to stand at its
    /// path since.
    [[nodiscard]] std::string name() const;

  private:
    std::filesystem::path path_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

}  // namespace samara
