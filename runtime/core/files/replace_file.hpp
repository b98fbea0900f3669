#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string_view>

namespace samara {

/// Throws Error where the file cannot be written, as far as can be known beforehand: its folder does not
/// exist or takes no files, or it is a folder itself.
void require_writable(const std::filesystem::path& target);

/// Throws Error where a folder takes no files or, where it does not exist, cannot be made together with its
/// parents.
void require_folder_to_make(const std::filesystem::path& folder);

/// Writes a file so that a reader never sees it half-written: `write` fills an empty temporary file on the
/// same disk, which is then synced to the disk and put in the place of `target`. If `write` throws, `target`
/// stays as it was, and the exception passes on. The temporary file has no name where the file system allows
/// it, so that nothing is left of it when the program is killed. Throws Error where the folder cannot be
/// written or the disk is full.
void replace_file(const std::filesystem::path& target,
                  const std::function<void(const std::filesystem::path& temporary)>& write);

/// Writes a file as replace_file() does, for libraries that need a file's name: the temporary file has one in
/// the folder, and the next call for a file there removes those that killed programs left.
void replace_file_by_name(const std::filesystem::path& target,
                          const std::function<void(const std::filesystem::path& temporary)>& write);

/// Writes a file as replace_file() does, from its beginning to its end: `write` fills a stream of bytes.
void replace_file_by_stream(const std::filesystem::path& target,
                            const std::function<void(std::ostream& stream)>& write);

/// Writes the bytes to a file as replace_file() does.
void replace_file_with(const std::filesystem::path& target, std::string_view bytes);

}  // namespace samara
