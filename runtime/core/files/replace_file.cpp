#include "samara/core/files/replace_file.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"

namespace samara {
namespace {

Error cannot_be_written(const std::filesystem::path& target) {
    return Error(fmt::format("{}: cannot be written: {}", target.string(), std::strerror(errno)));
}

/// Returns a mark that tells the processes that this one can see from those of other machines and containers.
const std::string& place_of_processes() {
    static const std::string place = [] {
        std::array<char, 256> host = {};
        (void)::gethostname(host.data(), host.size() - 1);
        std::error_code unknown;
        const auto space = std::filesystem::read_symlink("/proc/self/ns/pid", unknown);
        return content_hash(host.data() + space.string()).substr(0, 12);
    }();
    return place;
}

std::string prefix_of_names() {
    return fmt::format(".samara.{}.", place_of_processes());
}

/// Removes the temporary files of processes that were killed: ".samara.PLACE.PROCESS.NUMBER.tmp".
void remove_files_of_dead_processes(const std::filesystem::path& folder) {
    const std::string prefix = prefix_of_names();
    std::error_code failure;
    for (std::filesystem::directory_iterator entry(folder, failure), end; !failure && entry != end;
         entry.increment(failure)) {
        const std::string name = entry->path().filename().string();
        if (!name.starts_with(prefix) || !name.ends_with(".tmp")) continue;
        const int process = std::atoi(name.c_str() + prefix.size());
        if (process <= 0 || ::kill(process, 0) == 0 || errno != ESRCH) continue;
        ::unlink(entry->path().c_str());
    }
}

/// A file in the folder of `target` that becomes `target` or vanishes.
class TemporaryFile {
  public:
    TemporaryFile(const std::filesystem::path& target, bool named)
        : target_(target), folder_(target.has_parent_path() ? target.parent_path() : ".") {
        if (!named && open_without_name()) return;
        remove_files_of_dead_processes(folder_);
        take_name();
        descriptor_ = ::open(name_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        if (descriptor_ < 0) throw cannot_be_written(target);
        path_ = name_;
    }
    ~TemporaryFile() {
        if (!name_.empty()) ::unlink(name_.c_str());
        ::close(descriptor_);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    void become_target() {
        if (::fsync(descriptor_) != 0) throw cannot_be_written(target_);
        if (name_.empty()) {
            take_name();
            ::unlink(name_.c_str());  // left by an earlier process of the same number
            if (::linkat(AT_FDCWD, path_.c_str(), AT_FDCWD, name_.c_str(), AT_SYMLINK_FOLLOW) != 0) {
                throw cannot_be_written(target_);
            }
        }
        if (::rename(name_.c_str(), target_.c_str()) != 0) throw cannot_be_written(target_);
        name_.clear();
    }

  private:
    bool open_without_name() {
        descriptor_ = ::open(folder_.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
        if (descriptor_ < 0) return false;
        // The process by its number, since other programs write to it too.
        path_ = fmt::format("/proc/{}/fd/{}", ::getpid(), descriptor_);
        if (::access(path_.c_str(), W_OK) == 0) return true;
        ::close(descriptor_);
        return false;
    }
    void take_name() {
        static std::atomic<unsigned> count = 0;
        name_ = folder_ / fmt::format("{}{}.{}.tmp", prefix_of_names(), ::getpid(), ++count);
    }

    std::filesystem::path target_;
    std::filesystem::path folder_;
    std::filesystem::path name_;  ///< in the folder; empty while it has none
    std::filesystem::path path_;  ///< to write to
    int descriptor_ = -1;
};

void replace(const std::filesystem::path& target,
             const std::function<void(const std::filesystem::path&)>& write, bool named) {
    require_writable(target);
    TemporaryFile temporary(target, named);
    write(temporary.path());
    temporary.become_target();
}

}  // namespace

void require_writable(const std::filesystem::path& target) {
    const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
    std::error_code unknown;  // where this check fails, writing fails later, with its reason
    if (!std::filesystem::exists(folder, unknown) && !unknown) {
        throw Error(fmt::format("{}: the folder {} does not exist; create it first", target.string(),
                                folder.string()));
    }
    struct stat status = {};
    if (::lstat(target.c_str(), &status) != 0 && errno == ENAMETOOLONG) throw cannot_be_written(target);
    if (std::filesystem::is_directory(target, unknown)) {
        throw Error(fmt::format("{}: is a folder; give the name of a file", target.string()));
    }
    if (::access(folder.c_str(), W_OK | X_OK) != 0) throw cannot_be_written(target);
}

void require_folder_to_make(const std::filesystem::path& folder) {
    std::error_code unknown;
    std::filesystem::path there = folder.empty() ? "." : folder;
    while (!there.empty() && !std::filesystem::exists(there, unknown)) {
        there = there.has_parent_path() && there != there.parent_path() ? there.parent_path() : ".";
    }
    if (!std::filesystem::is_directory(there, unknown)) {
        throw Error(fmt::format("{}: cannot be created, as {} is a file; give another folder",
                                folder.string(), there.string()));
    }
    if (::access(there.c_str(), W_OK | X_OK) != 0) throw cannot_be_written(folder);
}

void replace_file(const std::filesystem::path& target,
                  const std::function<void(const std::filesystem::path&)>& write) {
    replace(target, write, false);
}

void replace_file_by_name(const std::filesystem::path& target,
                          const std::function<void(const std::filesystem::path&)>& write) {
    replace(target, write, true);
}

void replace_file_by_stream(const std::filesystem::path& target,
                            const std::function<void(std::ostream&)>& write) {
    replace_file(target, [&](const std::filesystem::path& temporary) {
        std::ofstream stream(temporary, std::ios::binary);
        write(stream);
        stream.close();
        if (!stream) {
            throw Error(fmt::format("{}: cannot be written: {}", target.string(), std::strerror(errno)));
        }
    });
}

void replace_file_with(const std::filesystem::path& target, std::string_view bytes) {
    replace_file_by_stream(target, [&](std::ostream& stream) {
        stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    });
}

}  // namespace samara
