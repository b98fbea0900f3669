#include "samara/core/files/file_digest.hpp"

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

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"

namespace samara {
namespace {

constexpr std::string_view label = "\nsamara xxh128 ";
constexpr std::size_t digest_bytes = label.size() + 32 + 1;

/// The digest of the first `size` bytes, as it stands in files.
std::string digest_of(const InputFile& file, std::uint64_t size) {
    return fmt::format("{}{}\n", label, content_hash(file, size));
}

std::string end_of(const InputFile& file) {
    if (file.size() < digest_bytes) return {};
    std::string end(digest_bytes, '\0');
    end.resize(file.read_at(file.size() - digest_bytes, end.data(), digest_bytes));
    return end;
}

/// Files whose digest was right, in this process.
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
    return end_of(file).starts_with(label);
}

bool verify_digest(const InputFile& file) {
    const std::string end = end_of(file);
    if (!end.starts_with(label)) return false;
    const FileState state = state_of(file);
    if (known_files().hold(state)) return true;
    if (digest_of(file, file.size() - digest_bytes) != end) {
        throw Error(fmt::format("{}: is damaged (its digest is not that of its content); make it again",
                                file.path().string()));
    }
    // A file that was changed a moment ago may change again within its clock's tick.
    if (std::time(nullptr) - std::get<3>(state) > 2) known_files().add(state);
    return true;
}

}  // namespace samara
