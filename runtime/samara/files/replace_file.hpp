#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string_view>

namespace samara {

/// Writes a file so that a reader never sees it half-written: `write` fills a temporary file beside `target`,
/// which is then synced to the disk and renamed over `target`. If `write` throws, the temporary file is
/// removed, `target` stays as it was, and the exception passes on. Throws Error where the folder cannot be
/// written or the disk is full.
void replace_file(const std::filesystem::path& target,
                  const std::function<void(const std::filesystem::path& temporary)>& write);

/// replace_file for a file that is written from its beginning to its end: `write` fills a stream of bytes.
void replace_file_by_stream(const std::filesystem::path& target,
                            const std::function<void(std::ostream& stream)>& write);

/// replace_file with the given bytes.
void replace_file_with(const std::filesystem::path& target, std::string_view bytes);

}  // namespace samara
