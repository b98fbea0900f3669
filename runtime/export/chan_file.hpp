#pragma once

#include <filesystem>
#include <vector>

#include "samara/export/export_progress.hpp"
#include "samara/motion/motion.hpp"

namespace samara {

/// The program whose channel files are written: its columns and its default order of rotations.
enum class ChanLayout {
    nuke,     ///< frame tx ty tz rx ry rz; order ZXY: first about z, then x, then y, R = Ry Rx Rz
    houdini,  ///< tx ty tz rx ry rz, a row for each frame; order XYZ: first about x, R = Rz Ry Rx
};

/// Writes one run of a motion as channel files (.chan), one for each body and copy: a line for each frame
/// with the columns of the layout.
///
/// Frame: time times frame rate, whole (frame 0 at 0 s). Position (m) of the shape file's origin and angles
/// (degrees), with y up, as Nuke and Houdini have it: shape and world alike are rotated as in .glb, (x, y, z)
/// -> (x, z, -y), so that a body in the shape file's own attitude has the angles 0 0 0. Angles are
/// continuous: of the triples that give one rotation, whole revolutions included, that nearest to the line
/// before; the last rotation (ry for Nuke, rz for Houdini) goes on where the middle one is a right angle to
/// 1e-9. Numbers are the shortest text that reads back as the same double. A motion of one copy of one body
/// is written to `file` itself; else each to its own file beside it, STEM_NAME.chan with copy_name(), counted
/// from `first_copy`, slashes as underscores. Returns the files; `progress` counts them. Throws Error where
/// one cannot be written, or where the frames are not at whole multiples of the frame's duration. `run` must
/// be in the motion.
std::vector<std::filesystem::path> write_chan(const std::filesystem::path& file, const Motion& motion,
                                              int run = 0, const ExportProgress& progress = {},
                                              ChanLayout layout = ChanLayout::nuke, int first_copy = 0);

}  // namespace samara
