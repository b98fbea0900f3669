#include "internal/files/share_folder.hpp"

#include <cstdlib>

#include <fmt/format.h>

#include "samara/base/error.hpp"

namespace samara {

namespace fs = std::filesystem;

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
    if (is_one(share.source)) return share.source;
    throw Error(
        fmt::format("{}: {} are not installed there; install samara again, or name their folder in {}",
                    installed.string(), share.contents, share.variable));
}

}  // namespace samara
