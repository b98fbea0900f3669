#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace samara {

class InputFile;

/// The XXH3 128-bit hash of the bytes, as 32 lower-case hexadecimal digits (what the tool xxh128sum prints).
std::string content_hash(std::string_view bytes);

/// content_hash of the first `size` bytes of a file, with memory for a small part of them. Throws Error where
/// it cannot be read.
std::string content_hash(const InputFile& file, std::uint64_t size);

/// content_hash of a file's bytes. Throws Error where the file cannot be read.
std::string file_content_hash(const std::filesystem::path& file);

/// The bytes of a regular file as they are. Throws Error where it is none or cannot be read.
std::string read_bytes(const std::filesystem::path& file);

}  // namespace samara
