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

/// The most that is read of a mesh, .stl, .obj or .glb (bytes): some 20 million triangles.
inline constexpr std::size_t most_mesh_bytes = std::size_t{1} << 30U;

/// What keeps a path from being read as a file, for a message behind its name: "there is no such file", "is a
/// folder; give a file", "is a pipe, socket or device; give a file", "cannot be read: Permission denied";
/// empty where nothing does. Never throws for any path.
std::string reading_error(const std::filesystem::path& path);

/// The bytes of a regular file. Throws Error, "PATH: reading_fault()", where it is none or cannot be read,
/// and where it holds more than `most`.
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
    /// Up to `size` bytes at the place; fewer where the file ends. Throws Error where it cannot be read.
    std::size_t read_at(std::uint64_t place, char* bytes, std::size_t size) const;
    /// All that it held when it was opened. Throws Error where it cannot be read or holds more than `most`.
    [[nodiscard]] std::string bytes(std::size_t most) const;
    /// Whether the file that is open stands beneath the folder, wherever links lead.
    [[nodiscard]] bool is_beneath(const std::filesystem::path& folder) const;

  private:
    std::filesystem::path path_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

/// What tells one state of a file from another: device, inode, size and the time of the last change.
using FileState = std::tuple<dev_t, ino_t, off_t, std::time_t, long>;

FileState state_of(const InputFile& file);

/// How many lists and objects of a JSON text may be open at once: readers work by recursion.
inline constexpr int most_json_depth = 100;

/// What is wrong with the size or the depth of a JSON text, or an empty text: whoever reads it stays within
/// 64 MB and most_json_depth.
std::string error_of_json_size(std::string_view text);

}  // namespace samara
