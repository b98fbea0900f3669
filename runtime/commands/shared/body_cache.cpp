#include "samara/commands/shared/body_cache.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <exception>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/base/version.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"

namespace samara {
namespace {

constexpr std::string_view ending = ".body.h5";

std::string environment(const char* variable) {
    const char* value = std::getenv(variable);
    return value == nullptr ? "" : value;
}

/// Returns the folder that the environment names; empty where there is none.
std::filesystem::path chosen_folder() {
    const std::string chosen = environment("SAMARA_CACHE");
    if (chosen == "off") return {};
    if (!chosen.empty()) return chosen;
    const std::filesystem::path common = environment("XDG_CACHE_HOME");
    if (common.is_absolute()) return common / "samara";
    const std::filesystem::path home = environment("HOME");
    return home.is_absolute() ? home / ".cache" / "samara" : std::filesystem::path();
}

/// Returns whether the path is, of this user, of that type and closed to the others.
bool is_own(const std::filesystem::path& path, mode_t type, mode_t closed) {
    struct stat status = {};
    return ::lstat(path.c_str(), &status) == 0 && (status.st_mode & S_IFMT) == type &&
           status.st_uid == ::geteuid() && (status.st_mode & closed) == 0;
}

/// Makes the folder, with those above it, where it is not there.
bool is_ready(const std::filesystem::path& folder) {
    std::error_code failure;
    if (folder.has_parent_path()) std::filesystem::create_directories(folder.parent_path(), failure);
    (void)::mkdir(folder.c_str(), S_IRWXU);
    return is_own(folder, S_IFDIR, S_IRWXG | S_IRWXO) && ::access(folder.c_str(), W_OK | X_OK) == 0;
}

/// Reads a kept body; nothing where there is none or it is damaged.
std::optional<Body> read_entry(const std::filesystem::path& entry) {
    if (!is_own(entry, S_IFREG, S_IWGRP | S_IWOTH)) return std::nullopt;
    try {
        Body body = read_body_file(entry);
        std::error_code ignored;
        std::filesystem::last_write_time(entry, std::filesystem::file_time_type::clock::now(), ignored);
        return body;
    } catch (const std::exception&) {
        std::error_code ignored;
        std::filesystem::remove(entry, ignored);
        return std::nullopt;
    }
}

/// Identifies the installed samara-mesh: programs of different builds differ in size or time.
std::string mesher() {
    struct stat status = {};
    const auto program = find_program("samara-mesh");
    if (!program || ::stat(program->c_str(), &status) != 0) return "none";
    return fmt::format("{} {}.{}", status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec);
}

/// Returns whether a script of gmsh may depend on more than itself: other files, the environment, the time,
/// random numbers, or words that it puts together. A false alarm costs time alone.
bool may_depend_on_more(std::string_view script) {
    constexpr std::array<std::string_view, 17> words = {
        "Include", "Merge", "File",     "Exists",   "Get",    "Rand",  "Cpu",  "Memory", "Today",
        "Onelab",  "Dir",   "Relocate", "Absolute", "Plugin", "GMSH_", "MPI_", "Str"};
    return std::any_of(words.begin(), words.end(),
                       [&](std::string_view word) { return script.find(word) != std::string_view::npos; });
}

}  // namespace

BodyCache::BodyCache(std::uintmax_t most_bytes) : most_bytes_(most_bytes) {
    const std::filesystem::path folder = chosen_folder();
    if (!folder.empty() && is_ready(folder)) folder_ = folder;
}

std::filesystem::path BodyCache::entry_of(const std::string& key) const {
    return *folder_ / (content_hash(key) + std::string(ending));
}

std::optional<Body> BodyCache::find(const std::string& key) const {
    if (!folder_) return std::nullopt;
    return read_entry(entry_of(key));
}

void BodyCache::keep(const std::string& key, const Body& body) const {
    if (!folder_) return;
    try {
        write_body_file(entry_of(key), body);
        remove_oldest();
    } catch (const std::exception&) {  // a full disk, a folder that is gone: the next run makes it again
        return;
    }
}

void BodyCache::remove_oldest() const {
    struct Entry {
        std::filesystem::file_time_type used;
        std::uintmax_t bytes;
        std::filesystem::path path;
    };
    std::vector<Entry> entries;
    std::uintmax_t sum = 0;
    std::error_code failure;
    for (std::filesystem::directory_iterator file(*folder_, failure), end; !failure && file != end;
         file.increment(failure)) {
        if (!file->path().filename().string().ends_with(ending)) continue;
        std::error_code gone;  // by another process
        const auto used = file->last_write_time(gone);
        const std::uintmax_t bytes = gone ? 0 : file->file_size(gone);
        if (gone) continue;
        entries.push_back({used, bytes, file->path()});
        sum += bytes;
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
    for (const Entry& entry : entries) {
        if (sum <= most_bytes_) return;
        std::error_code ignored;
        std::filesystem::remove(entry.path, ignored);
        sum -= entry.bytes;
    }
}

std::optional<std::string> body_key(const std::filesystem::path& file) {
    std::string format = file.extension().string();
    std::transform(format.begin(), format.end(), format.begin(),
                   [](char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
    if (format == ".geo" && may_depend_on_more(read_bytes(file))) return std::nullopt;
    return fmt::format("{}\n{}\n{}\n{}", file.filename().string(), file_content_hash(file), version,
                       mesher());
}

}  // namespace samara
