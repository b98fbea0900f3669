#include "samara/core/files/input_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/machine_memory.hpp"

namespace samara {
namespace {

constexpr const char* is_folder = "is a folder; give a file";

std::string in_words(int reason) {
    return reason == ENOENT ? "does not exist; check the name"
                            : fmt::format("cannot be read: {}", std::strerror(reason));
}

/// Returns why something at a path is no file; empty where it is one.
std::string error_of_type(const struct stat& status) {
    if (S_ISREG(status.st_mode)) return {};
    return S_ISDIR(status.st_mode) ? is_folder : "is a pipe, socket or device; give a file";
}

Error error(const std::filesystem::path& path, const std::string& what) {
    return Error(fmt::format("{}: {}", path.string(), what));
}

constexpr std::size_t most_bytes = 64U << 20U;

/// Returns the most lists and objects that are open at once; of a text that is no JSON, at least as many as a
/// parser opens before it finds out.
int depth_of(std::string_view text) {
    int depth = 0;
    int deepest = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char letter = text[i];
        if (in_string) {
            if (letter == '\\') ++i;  // the next character ends no string
            in_string = letter != '"';
        } else if (letter == '"') {
            in_string = true;
        } else if (letter == '[' || letter == '{') {
            deepest = std::max(deepest, ++depth);
        } else if (letter == ']' || letter == '}') {
            --depth;
        }
    }
    return deepest;
}

}  // namespace

std::string reading_error(const std::filesystem::path& path) {
    struct stat status = {};
    if (::stat(path.c_str(), &status) != 0) return in_words(errno);
    if (std::string type = error_of_type(status); !type.empty()) return type;
    return ::access(path.c_str(), R_OK) == 0 ? "" : in_words(errno);
}

std::string read_at_most(const std::filesystem::path& path, std::size_t most) {
    return InputFile(path).bytes(most);
}

InputFile::InputFile(const std::filesystem::path& path)
    : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
    struct stat status = {};
    // A socket cannot be opened, nor a device without a driver: its type explains more than the system's
    // reason.
    if (descriptor_ < 0) {
        const int reason = errno;
        const std::string type = ::stat(path.c_str(), &status) == 0 ? error_of_type(status) : "";
        throw error(path, type.empty() ? in_words(reason) : type);
    }
    const std::string what = ::fstat(descriptor_, &status) == 0 ? error_of_type(status) : in_words(errno);
    if (!what.empty()) {
        ::close(descriptor_);
        throw error(path, what);
    }
    size_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::~InputFile() {
    ::close(descriptor_);
}

std::string InputFile::name() const {
    const std::string own = fmt::format("/proc/self/fd/{}", descriptor_);
    return ::access(own.c_str(), R_OK) == 0 ? own : path_.string();
}

std::size_t InputFile::read_at(std::uint64_t place, char* bytes, std::size_t size) const {
    std::size_t done = 0;
    while (done < size) {
        const ssize_t count =
            ::pread(descriptor_, bytes + done, size - done, static_cast<off_t>(place + done));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw error(path_, in_words(errno));
        if (count == 0) break;
        done += static_cast<std::size_t>(count);
    }
    return done;
}

std::string InputFile::bytes(std::size_t most) const {
    if (size_ > most) {
        throw error(path_, fmt::format("has more than {} bytes; check that it is the right file", most));
    }
    require_memory(static_cast<double>(size_), path_.string() + ": its content",
                   "check that it is the right file");
    std::string bytes(size_, '\0');
    bytes.resize(read_at(0, bytes.data(), bytes.size()));
    return bytes;
}

bool InputFile::is_beneath(const std::filesystem::path& folder) const {
    std::error_code unknown;
    std::filesystem::path real =
        std::filesystem::read_symlink(fmt::format("/proc/self/fd/{}", descriptor_), unknown);
    if (unknown) real = std::filesystem::canonical(path_, unknown);
    const std::filesystem::path top = std::filesystem::canonical(folder.empty() ? "." : folder, unknown);
    if (unknown) return false;
    return std::mismatch(top.begin(), top.end(), real.begin(), real.end()).first == top.end();
}

FileState state_of(const InputFile& file) {
    struct stat status = {};
    ::fstat(file.descriptor(), &status);
    return {status.st_dev, status.st_ino, status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

std::string error_of_json_size(std::string_view text) {
    if (text.size() > most_bytes) return fmt::format("is longer than {} MB", most_bytes >> 20U);
    if (depth_of(text) <= most_json_depth) return {};
    return fmt::format("nests lists and objects more than {} deep", most_json_depth);
}

}  // namespace samara
