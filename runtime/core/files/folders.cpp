#include "samara/core/files/folders.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "samara/core/base/error.hpp"

namespace samara {

namespace fs = std::filesystem;

namespace {

constexpr const char* prefix = "samara-tmp-";

/// Opens and locks a folder of the user's own; -1 where it is gone, or where another process holds the lock
/// and `wait` is false.
int locked(const std::filesystem::path& folder, bool wait) {
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor < 0) return -1;
    struct stat status = {};
    const bool taken = ::flock(descriptor, wait ? LOCK_EX : LOCK_EX | LOCK_NB) == 0 &&
                       ::fstat(descriptor, &status) == 0 && status.st_nlink > 0 &&
                       status.st_uid == ::geteuid();
    if (taken) return descriptor;
    ::close(descriptor);
    return -1;
}

void remove_folders_of_dead_processes(const std::filesystem::path& parent) {
    std::error_code failure;
    for (std::filesystem::directory_iterator entry(parent, failure), end; !failure && entry != end;
         entry.increment(failure)) {
        if (!entry->path().filename().string().starts_with(prefix)) continue;
        const int lock = locked(entry->path(), false);
        if (lock < 0) continue;
        std::error_code ignored;
        std::filesystem::remove_all(entry->path(), ignored);
        ::close(lock);
    }
}

/// Returns the folder of the library that this code is part of, such as a Python module's; empty where that
/// is the program itself.
fs::path library_folder(const fs::path& program) {
    Dl_info info = {};
    const bool known = dladdr(reinterpret_cast<const void*>(&find_share_folder), &info) != 0;
    const fs::path file = known && info.dli_fname != nullptr ? info.dli_fname : "";
    std::error_code unknown;
    const bool is_library = file.is_absolute() && !fs::equivalent(file, program, unknown);
    return is_library ? file.parent_path() : fs::path();
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
    std::error_code unknown;
    const std::filesystem::path parent = std::filesystem::temp_directory_path(unknown);
    if (unknown) {
        throw Error(fmt::format("TMPDIR: is not a folder ({}); set it to a folder that can be written",
                                unknown.message()));
    }
    remove_folders_of_dead_processes(parent);
    // Another process may take the new folder for an abandoned one before it is locked; some file systems
    // lock nothing.
    for (int attempt = 0; attempt < 10 && lock_ < 0; ++attempt) {
        if (attempt > 0) std::filesystem::remove(path_, unknown);
        std::string pattern = (parent / prefix).string() + "XXXXXX";
        if (::mkdtemp(pattern.data()) == nullptr) {
            throw Error(fmt::format(
                "{}: a temporary folder cannot be created: {}; set TMPDIR to a folder that can be written",
                parent.string(), std::strerror(errno)));
        }
        path_ = pattern;
        lock_ = locked(path_, true);
    }
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
    if (lock_ >= 0) ::close(lock_);
}

fs::path find_share_folder(const ShareFolder& share) {
    std::error_code unknown;
    const auto is_one = [&](const fs::path& folder) {
        return fs::is_directory(folder, unknown) && fs::exists(folder / share.mark, unknown);
    };
    const char* chosen = std::getenv(share.variable);
    if (chosen != nullptr && *chosen != '\0') {
        if (is_one(chosen)) return chosen;
        const bool is_folder = fs::is_directory(chosen, unknown);
        throw Error(fmt::format("{} names {}, which {}{}; unset it, or name the folder of {}", share.variable,
                                chosen, is_folder ? "holds no " : "is not a folder",
                                is_folder ? share.mark : "", share.contents));
    }
    const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
    const fs::path installed = program.parent_path().parent_path() / "share/samara" / share.name;
    if (is_one(installed)) return installed;
    const fs::path library = library_folder(program);
    if (!library.empty() && is_one(library / share.name)) return library / share.name;
    if (is_one(share.source)) return share.source;
    throw Error(
        fmt::format("{}: {} are not installed there; install samara again, or name their folder in {}",
                    installed.string(), share.contents, share.variable));
}

}  // namespace samara
