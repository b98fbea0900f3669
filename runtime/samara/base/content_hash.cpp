#include "samara/base/content_hash.hpp"

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
    if (!stream || std::filesystem::is_directory(file)) {
        throw Error(
            fmt::format("{}: cannot be read; check that the file exists and may be opened", file.string()));
    }
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::string file_content_hash(const std::filesystem::path& file) {
    return content_hash(read_bytes(file));
}

}  // namespace samara
