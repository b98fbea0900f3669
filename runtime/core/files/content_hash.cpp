#include "samara/core/files/content_hash.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <string_view>

#define XXH_INLINE_ALL
#include <fmt/format.h>
#include <xxhash.h>

#include "samara/core/base/error.hpp"
#include "samara/core/files/input_file.hpp"

namespace samara {
namespace {

std::string in_digits(const XXH128_hash_t& hash) {
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

constexpr std::string_view label = "\nsamara xxh128 ";
constexpr std::size_t digest_bytes = label.size() + 32 + 1;

/// Returns the digest of the first `size` bytes, as it stands in files.
std::string digest_of(const InputFile& file, std::uint64_t size) {
    return fmt::format("{}{}\n", label, content_hash(file, size));
}

std::string end_of(const InputFile& file) {
    if (file.size() < digest_bytes) return {};
    std::string end(digest_bytes, '\0');
    end.resize(file.read_at(file.size() - digest_bytes, end.data(), digest_bytes));
    return end;
}

/// The states of the files whose digest this process has found right.
class KnownFiles {
  public:
    [[nodiscard]] bool hold(const FileState& state) {
        const std::lock_guard lock(mutex_);
        return states_.contains(state);
    }
    void add(const FileState& state) {
        const std::lock_guard lock(mutex_);
        states_.insert(state);
    }

  private:
    std::mutex mutex_;
    std::set<FileState> states_;
};

KnownFiles& known_files() {
    static KnownFiles files;
    return files;
}

}  // namespace

std::string content_hash(std::string_view bytes) {
    return in_digits(XXH3_128bits(bytes.data(), bytes.size()));
}

std::string content_hash(const InputFile& file, std::uint64_t size) {
    const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(),
                                                                                XXH3_freeState);
    XXH3_128bits_reset(state.get());
    std::array<char, 1U << 17U> part;  // NOLINT(cppcoreguidelines-pro-type-member-init): it is read into
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

void append_digest(const std::filesystem::path& path) {
    const InputFile file(path);
    const std::string digest = digest_of(file, file.size());
    const std::unique_ptr<FILE, int (*)(FILE*)> stream(std::fopen(path.c_str(), "ab"), std::fclose);
    const bool written = stream != nullptr &&
                         std::fwrite(digest.data(), 1, digest.size(), stream.get()) == digest.size() &&
                         std::fflush(stream.get()) == 0;
    if (!written) throw Error(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(errno)));
}

bool has_digest(const InputFile& file) {
    return !digest_in(file).empty();
}

std::string digest_in(const InputFile& file) {
    const std::string end = end_of(file);
    return end.starts_with(label) ? end.substr(label.size(), 32) : "";
}

bool verify_digest(const InputFile& file) {
    const std::string end = end_of(file);
    if (!end.starts_with(label)) return false;
    const FileState state = state_of(file);
    if (known_files().hold(state)) return true;
    if (digest_of(file, file.size() - digest_bytes) != end) {
        throw Error(fmt::format("{}: is damaged (its digest does not match its content); make it again",
                                file.path().string()));
    }
    // A file that was changed a moment ago may change again within its clock's tick.
    if (std::time(nullptr) - std::get<3>(state) > 2) known_files().add(state);
    return true;
}

}  // namespace samara
