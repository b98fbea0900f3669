#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "samara/core/files/input_file.hpp"

namespace samara {

/// Returns the XXH3 128-bit hash of the bytes, as 32 lower-case hexadecimal digits (as the tool xxh128sum
/// prints it).
std::string content_hash(std::string_view bytes);

/// Returns content_hash() of the first `size` bytes of a file, read piece by piece. Throws Error where it
/// cannot be read.
std::string content_hash(const InputFile& file, std::uint64_t size);

/// Returns content_hash() of a file's bytes. Throws Error where the file cannot be read.
std::string file_content_hash(const std::filesystem::path& file);

/// Returns the bytes of a regular file. Throws Error where it is none or cannot be read.
std::string read_bytes(const std::filesystem::path& file);

// The digest of a whole file stands behind its content in 48 bytes: a line break, "samara xxh128 ", the XXH3
// 128-bit hash of all bytes before it in 32 hexadecimal digits, and a line break. HDF5 does not look behind
// its content, and cuts the digest off when another program changes the file.

/// Appends the digest to the file, which it reads piece by piece. Throws Error where it cannot be written.
void append_digest(const std::filesystem::path& file);

/// Returns whether the file ends in a digest. Throws Error where it cannot be read.
bool has_digest(const InputFile& file);

/// Returns the hash that the file's digest holds; empty where it has none. Throws Error where it cannot be
/// read.
std::string digest_in(const InputFile& file);

/// Returns has_digest(). Throws Error where the digest is not that of the file's bytes. A file that has not
/// changed since this process last verified it is not read again.
bool verify_digest(const InputFile& file);

}  // namespace samara
