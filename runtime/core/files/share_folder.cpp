#include "samara/core/files/share_folder.hpp"

#include <cstdlib>

#include <dlfcn.h>
#include <fmt/format.h>

#include "samara/core/base/error.hpp"

namespace samara {

namespace fs = std::filesystem;

namespace {

/// The folder of the library that this code is part of, such as a Python module's; empty where that is the
/// program itself.
fs::path library_folder(const fs::path& program) {
    Dl_info info = {};
    const bool known = dladdr(reinterpret_cast<const void*>(&find_share_folder), &info) != 0;
    const fs::path file = known && info.dli_fname != nullptr ? info.dli_fname : "";
    std::error_code unknown;
    const bool is_library = file.is_absolute() && !fs::equivalent(file, program, unknown);
    return is_library ? file.parent_path() : fs::path();
}

}  // namespace

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
                                chosen, is_folder ? "holds no " : "is no folder", is_folder ? share.mark : "",
                                share.contents));
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
