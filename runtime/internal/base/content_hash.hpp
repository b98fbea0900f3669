#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace samara {

/// The XXH3 128-bit hash of the bytes, as 32 lower-case hexadecimal digits (what the tool xxh128sum prints).
std::string content_hash(std::string_view bytes);

/// content_hash of a file's bytes. Throws Error where the file cannot be read.
std::string file_content_hash(const std::filesystem::path& file);

/// A file's bytes as they are. Throws Error where the file cannot be read.
std::string read_bytes(const std::filesystem::path& file);

}  // namespace samara
