#pragma once

#include <filesystem>
#include <optional>

#include "samara/export/copy_style.hpp"
#include "samara/motion/motion.hpp"

namespace samara {

/// Writes one run of a motion as a binary glTF 2.0 file (.glb) for animation tools and web viewers.
///
/// Each body is one mesh with smooth normals and sharp creases (shaded_mesh.hpp), shared by its copies. Each
/// copy is a node called style.name(), placed at its first frame, with a translation and a rotation channel
/// of the animation "motion": keys at frames of the motion, linear interpolation (spherical for rotations),
/// quaternions with continuous signs. Frames that the keys around them give within `tolerance` (m; 0: none;
/// not given: the default of key_tolerance()) have no key of their own. A motion of one frame has no
/// animation. Values are floats; lengths are metres and times seconds.
///
/// Colours of `style` are a mesh each, with the body's accessors and a material of its own.
///
/// With `instances` a body of several copies is one node for each of its colours, with the copies as
/// instances (EXT_mesh_gpu_instancing, which the file requires: a reader without it rejects the file instead
/// of showing one copy). Instances cannot move: Error where the motion has more than one frame.
///
/// Each obstacle is a mesh and a node of its name, with a material that is seen from both sides; one that
/// moves has keys of its own.
///
/// Nodes move the shape file's origin. glTF has y up: shapes and keys alike are rotated by -90 degrees about
/// x, (x, y, z) -> (x, z, -y), with no parent node in between; importers that convert y up into z up, as
/// Blender does, thus arrive at the shape's own coordinates and at the motion's own positions and
/// quaternions.
///
/// Equal motions give equal bytes. Times must not be negative, as glTF asks, and must differ as floats; Error
/// else, and where the file cannot be written. `run` must be in the motion. Returns the number of keys.
std::size_t write_glb(const std::filesystem::path& file, const Motion& motion, int run = 0,
                      const std::optional<double>& tolerance = std::nullopt, const CopyStyle& style = {},
                      bool instances = false);

}  // namespace samara
