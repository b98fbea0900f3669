#include "converter/cases/case_links.hpp"

#include <fmt/format.h>

#include "samara/core/base/error.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

/// Where a link leads in the end, whether or not anything is there; empty for one that leads to itself.
fs::path end_of(const fs::path& link) {
    std::error_code fault;
    const fs::path end = fs::weakly_canonical(link.parent_path() / fs::read_symlink(link, fault), fault);
    return fault ? fs::path() : end;
}

}  // namespace

void require_links_within(const fs::path& folder) {
    std::error_code unreadable;
    const fs::path root = fs::canonical(folder, unreadable);
    if (unreadable) return;  // its reader says why
    for (fs::recursive_directory_iterator entry(folder, unreadable), end; !unreadable && entry != end;
         entry.increment(unreadable)) {
        const fs::file_type type = entry->symlink_status(unreadable).type();
        if (type == fs::file_type::symlink) {
            const fs::path inside = end_of(entry->path()).lexically_relative(root);
            if (!inside.empty() && *inside.begin() != "..") continue;
            throw Error(fmt::format(
                "{}: is a link that leads out of {}, and is not followed; put there what it leads to, "
                "or remove it",
                entry->path().string(), folder.string()));
        }
        if (type != fs::file_type::regular && type != fs::file_type::directory) {
            throw Error(fmt::format("{}: is neither a file nor a folder; remove it", entry->path().string()));
        }
    }
}

}  // namespace samara
