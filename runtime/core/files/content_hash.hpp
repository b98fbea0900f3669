#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "samara/core/files/input_file.hpp"

namespace samara {

/// The XXH3 128-bit hash of the bytes, as 32 lower-case hexadecimal digits (what the tool xxh128sum prints).
std::string content_hash(std::string_view bytes);

/// content_hash of the first `size` bytes of a file, with memory for a small part of them. Throws Error where
/// it cannot be read.
std::string content_hash(const InputFile& file, std::uint64_t size);

/// content_hash of a file's bytes. Throws Error where the file cannot be read.
std::string file_content_hash(const std::filesystem::path& file);

/// The bytes of a regular file as they are. Throws Error where it is none or cannot be read.
std::string read_bytes(const std::filesystem::path& file);

// A digest of a whole file behind its content: 48 bytes, a line break, "samara xxh128 ", the XXH3 128-bit
// hash of all bytes before in 32 hexadecimal digits, and a line break. HDF5 does not look behind its content,
// and cuts the digest off when another program changes the file.

/// Writes the digest at the file's end, with memory for a small part of it. Throws Error.
void append_digest(const std::filesystem::path& file);

/// Whether the file ends in a digest. Throws Error where it cannot be read.
bool has_digest(const InputFile& file);

/// has_digest(), where a digest that is not that of the file's bytes is an Error. A file that has not changed
/// since this process last looked is not read again.
bool verify_digest(const InputFile& file);

}  // namespace samara
