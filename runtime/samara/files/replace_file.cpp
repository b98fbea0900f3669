#include "samara/files/replace_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "samara/base/error.hpp"

namespace samara {
namespace {

void sync_to_disk(const std::filesystem::path& path, const std::filesystem::path& target) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    const bool synced = descriptor >= 0 && ::fsync(descriptor) == 0;
    const int reason = errno;
    if (descriptor >= 0) ::close(descriptor);
    if (!synced) {
        throw Error(fmt::format("{}: cannot be written: {}", target.string(), std::strerror(reason)));
    }
}

}  // namespace

void replace_file(const std::filesystem::path& target,
                  const std::function<void(const std::filesystem::path&)>& write) {
    const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
    std::error_code unknown;  // what cannot be looked at fails to be written, with its reason
    if (!std::filesystem::exists(folder, unknown) && !unknown) {
        throw Error(fmt::format("{}: the folder {} does not exist; create it first", target.string(),
                                folder.string()));
    }
    if (std::filesystem::is_directory(target, unknown)) {
        throw Error(fmt::format("{}: is a folder; give the name of a file", target.string()));
    }
    const std::filesystem::path temporary =
        folder / fmt::format(".{}.{}.tmp", target.filename().string(), ::getpid());
    try {
        write(temporary);
        sync_to_disk(temporary, target);
        std::error_code failure;
        std::filesystem::rename(temporary, target, failure);
        if (failure) {
            throw Error(fmt::format("{}: cannot be written: {}", target.string(), failure.message()));
        }
    } catch (...) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw;
    }
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
