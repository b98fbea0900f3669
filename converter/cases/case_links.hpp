#pragma once

#include <filesystem>

namespace samara {

/// Throws Error naming the first thing in the folder of cases, or below it, that reading would lead astray: a
/// link out of it, or what is neither a file, a folder nor a link (a pipe would keep its reader waiting).
/// Links within it, as those to meshes are, are as they should be. Follows none.
void require_links_within(const std::filesystem::path& folder);

}  // namespace samara
