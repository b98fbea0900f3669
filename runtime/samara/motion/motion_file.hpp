#pragma once

#include <filesystem>

#include "samara/motion/motion.hpp"

namespace samara {

/// Writes a motion file (docs/file-formats) through a temporary file: equal motions give equal bytes. It
/// stands alone: it holds the bodies' surfaces, the scene's text and all that measures, pictures and exports
/// need. Throws Error where the file cannot be written or the motion breaks one of read_motion_file's rules.
void write_motion_file(const std::filesystem::path& file, const Motion& motion);

/// Reads a motion file. Throws Error, naming the file and the place in it, where the file is missing, cut
/// short, damaged, of another kind or from a newer version, and where its content breaks a rule: there is a
/// frame, a body, a run and a copy; times ascend; all values are finite; all arrays agree on runs, frames and
/// copies; quaternions and axes have unit length to 1e-6; the surfaces hold triangles.
Motion read_motion_file(const std::filesystem::path& file);

/// Whether the file is an HDF5 file that holds a motion; false also where it cannot be read.
bool is_motion_file(const std::filesystem::path& file);

}  // namespace samara
