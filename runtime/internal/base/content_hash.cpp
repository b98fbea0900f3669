#include "internal/base/content_hash.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#define XXH_INLINE_ALL
#include <fmt/format.h>
#include <xxhash.h>

#include "samara/base/error.hpp"

namespace samara {

std::string content_hash(std::string_view bytes) {
    const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string read_bytes(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const int reason = errno;
    std::error_code unknown;  // of pipes, whose size nobody knows
    const bool is_folder = std::filesystem::is_directory(file, unknown);
    if (!stream || is_folder) {
        throw Error(
            fmt::format("{}: cannot be read: {}", file.string(), std::strerror(is_folder ? EISDIR : reason)));
    }
    const std::uintmax_t size = std::filesystem::file_size(file, unknown);
    std::string bytes(unknown ? 0 : size, '\0');
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(stream.gcount()));
    bytes.append(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
    return bytes;
}

std::string file_content_hash(const std::filesystem::path& file) {
    return content_hash(read_bytes(file));
}

}  // namespace samara
