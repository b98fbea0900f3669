#pragma once

#include <cstddef>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <string>
#include <string_view>
#include <tuple>

#include <sys/types.h>

namespace samara {

/// The largest mesh file, .stl, .obj or .glb, that is read (bytes): some 20 million triangles.
inline constexpr std::size_t most_mesh_bytes = std::size_t{1} << 30U;

/// Returns why a path cannot be read as a file, for a message behind its name: "there is no such file", "is a
/// folder; give a file", "is a pipe, socket or device; give a file", "cannot be read: Permission denied";
/// empty where it can. Never throws.
std::string reading_error(const std::filesystem::path& path);

/// Returns the bytes of a regular file. Throws Error, "PATH: " and reading_error(), where it is none or
/// cannot be read, and where it holds more than `most`.
std::string read_at_most(const std::filesystem::path& path, std::size_t most);

/// A regular file, open for reading as long as this object lives.
class InputFile {
  public:
    /// Opens the file. Throws Error, "PATH: " and reading_error(), where it is no regular file or cannot be
    /// read. It never waits for the other end of a pipe.
    explicit InputFile(const std::filesystem::path& path);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] int descriptor() const { return descriptor_; }
    [[nodiscard]] std::uint64_t size() const { return size_; }  ///< bytes, when it was opened
    /// Returns a name of this very file for libraries that open files themselves, even where another file now
    /// stands at its path.
    [[nodiscard]] std::string name() const;
    /// Reads up to `size` bytes at the place and returns their number; fewer where the file ends. Throws
    /// Error where it cannot be read.
    std::size_t read_at(std::uint64_t place, char* bytes, std::size_t size) const;
    /// Returns all bytes that it held when it was opened. Throws Error where it cannot be read or holds more
    /// than `most`.
    [[nodiscard]] std::string bytes(std::size_t most) const;
    /// Returns whether the open file lies beneath the folder, with all links resolved.
    [[nodiscard]] bool is_beneath(const std::filesystem::path& folder) const;

  private:
    std::filesystem::path path_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

/// Identifies a state of a file: device, inode, size and the time of the last change.
using FileState = std::tuple<dev_t, ino_t, off_t, std::time_t, long>;

FileState state_of(const InputFile& file);

/// The most lists and objects of a JSON text that may be open at once: readers work by recursion.
inline constexpr int most_json_depth = 100;

/// Returns what is wrong with the size or the depth of a JSON text, beyond 64 MB or most_json_depth; empty
/// where nothing is.
std::string error_of_json_size(std::string_view text);

}  // namespace samara
