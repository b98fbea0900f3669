#include "internal/files/input_file.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "samara/base/error.hpp"

namespace samara {
namespace {

constexpr const char* is_folder = "is a folder; give a file";

std::string in_words(int reason) {
    return reason == ENOENT ? "there is no such file"
                            : fmt::format("cannot be read: {}", std::strerror(reason));
}

Error fault(const std::filesystem::path& path, const std::string& what) {
    return Error(fmt::format("{}: {}", path.string(), what));
}

}  // namespace

std::string reading_fault(const std::filesystem::path& path) {
    struct stat status = {};
    if (::stat(path.c_str(), &status) != 0) return in_words(errno);
    if (S_ISDIR(status.st_mode)) return is_folder;
    return ::access(path.c_str(), R_OK) == 0 ? "" : in_words(errno);
}

std::string read_at_most(const std::filesystem::path& path, std::size_t most) {
    if (const std::string what = reading_fault(path); !what.empty()) throw fault(path, what);
    std::ifstream stream(path, std::ios::binary);
    std::string bytes;
    std::array<char, 1U << 16U> piece{};
    while (stream) {
        stream.read(piece.data(), piece.size());
        bytes.append(piece.data(), static_cast<std::size_t>(stream.gcount()));
        if (bytes.size() > most) {
            throw fault(path, fmt::format("holds more than {} bytes; is it the right file?", most));
        }
    }
    return bytes;
}

InputFile::InputFile(const std::filesystem::path& path)
    : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
    struct stat status = {};
    if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0) throw fault(path, in_words(errno));
    if (!S_ISREG(status.st_mode)) {
        ::close(descriptor_);
        throw fault(path, S_ISDIR(status.st_mode) ? is_folder : "is a pipe, socket or device; give a file");
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

}  // namespace samara
