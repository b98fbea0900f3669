#pragma once

#include <filesystem>
#include <optional>

#include "samara/export/copy_style.hpp"
#include "samara/motion/motion.hpp"

namespace samara {

/// A body of more copies than this becomes a point instancer in .usda files.
inline constexpr int most_usd_transforms = 19;

/// Writes one run of a motion as a USD stage in text (.usda): metres, z up, a time code for each frame of the
/// motion's frame rate (time code 0 at 0 s), the default prim /motion.
///
/// Each body has one Mesh. Each copy is an Xform called style.name() (letters, digits and underscores) with
/// time samples of xformOp:translate (double3, place of the shape file's origin) and xformOp:orient (quatf,
/// signs continuous), one a line; the copies after the first are instances of the first one's shape. Frames
/// that the samples around them give within `tolerance` (m; 0: none; not given: the default of
/// key_tolerance()) have no sample of their own: USD interpolates linearly, and orientations along the arc.
/// A motion of one frame has values without time, and no velocities.
/// A body of more than most_usd_transforms copies is a PointInstancer with all frames. Its orientations are
/// there twice: as `orientationsf` (quatf), which OpenUSD prefers from 24.03 on, and as `orientations`
/// (quath, to 5e-4), which every version reads. Positions are floats, as the schema asks.
/// Colours of `style` are primvars:displayColor of each Xform, which its mesh inherits, and of the
/// PointInstancer, one for each instance.
/// Images of display meshes are files in the folder STAGE.images beside it, which its materials name.
///
/// Normals are smooth over curved parts and sharp at creases (shaded_mesh.hpp). Numbers are the shortest text
/// that reads back as the same float or double. Equal motions give equal bytes. Throws Error where the file
/// cannot be written; `run` must be in the motion. Returns the number of time samples.
std::size_t write_usda(const std::filesystem::path& file, const Motion& motion, int run = 0,
                       const std::optional<double>& tolerance = std::nullopt, const CopyStyle& style = {});

}  // namespace samara
