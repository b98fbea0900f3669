#include "samara/core/files/content_hash.hpp"

#include <algorithm>
#include <memory>
#include <vector>

#define XXH_INLINE_ALL
#include <fmt/format.h>
#include <xxhash.h>

#include "samara/core/files/input_file.hpp"

namespace samara {
namespace {

std::string in_digits(const XXH128_hash_t& hash) {
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace

std::string content_hash(std::string_view bytes) {
    return in_digits(XXH3_128bits(bytes.data(), bytes.size()));
}

std::string content_hash(const InputFile& file, std::uint64_t size) {
    const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(),
                                                                                XXH3_freeState);
    XXH3_128bits_reset(state.get());
    std::vector<char> part(1U << 20U);
    for (std::uint64_t place = 0; place < size;) {
        const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(part.size(), size - place));
        const std::size_t count = file.read_at(place, part.data(), wanted);
        if (count == 0) break;
        XXH3_128bits_update(state.get(), part.data(), count);
        place += count;
    }
    return in_digits(XXH3_128bits_digest(state.get()));
}

std::string file_content_hash(const std::filesystem::path& path) {
    const InputFile file(path);
    return content_hash(file, file.size());
}

std::string read_bytes(const std::filesystem::path& file) {
    return read_at_most(file, std::string().max_size());
}

}  // namespace samara
