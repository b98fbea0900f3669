#pragma once

#include <filesystem>

#include "samara/core/body/body.hpp"

namespace samara {

/// Reads NAME.body.h5 (docs/file-formats). Throws Error where the file is missing, cut short, damaged, of
/// another type or from a newer version, or where its content breaks a rule: indices out of range, values
/// that are not finite, and what no real body can be (body_check.hpp).
Body read_body_file(const std::filesystem::path& file);

/// Writes NAME.body.h5 whole, through a temporary file: equal bodies give equal bytes. Throws Error.
void write_body_file(const std::filesystem::path& file, const Body& body);

/// Returns the hash of the surface as the body file stores it: tables and Kirchhoff tensors are valid for
/// this surface alone.
std::string surface_hash(const Surface& surface);

/// Returns the stem of a body or shape file's name: "rubber" for dir/rubber.body.h5 and for dir/rubber.stl.
std::string body_name_of(const std::filesystem::path& file);

/// Returns whether the name ends in .body.h5.
bool is_body_file_name(const std::filesystem::path& file);

}  // namespace samara
