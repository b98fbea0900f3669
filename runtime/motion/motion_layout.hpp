#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/hdf5_writer.hpp"
#include "samara/core/physics/obstacle.hpp"
#include "samara/core/surface/display_mesh.hpp"
#include "samara/motion/motion.hpp"

namespace samara {

/// The version of the format of motion files.
inline constexpr std::int64_t motion_format_version = 1;

/// Returns the name of the group of a body's uncertainties in a motion file: below it stands one group for
/// each cause, which holds a number for each metric.
std::string uncertainty_group(const std::string& body);

/// Returns the name of the dataset of a part of the fluid's forces on a body (parts_of_fluid_forces).
std::string forces_of(const std::string& body, const std::string& part);

/// Throws Error, naming the file, where a motion apart from its poses breaks a rule of read_motion_file that
/// a single dataset does not show.
void check_motion_but_poses(const std::filesystem::path& file, const Motion& motion);

/// Throws Error, naming the file, where some or all poses of a body break a rule of read_motion_file.
void check_poses(const std::filesystem::path& file, const std::string& body, const std::vector<Pose>& poses);

/// Throws Error, naming the file, where a motion or its poses break a rule of read_motion_file, or where
/// there is not one pose for each run, frame and copy.
void check_motion(const std::filesystem::path& file, const Motion& motion);

/// Writes a display mesh into a group of a motion file.
void write_display(Hdf5Writer& file, const std::string& group, const DisplayMesh& display);

/// Reads the display mesh of a group; null where there is none. Throws Error where its numbers are not those
/// of a mesh.
std::shared_ptr<const DisplayMesh> read_display(const Hdf5Reader& file, const std::string& group);

/// Writes obstacles as the groups /obstacles/NAME: surface, friction, and keys (n, 8) of time, position and
/// orientation. Writes nothing where there are none.
void write_obstacles(Hdf5Writer& file, const std::vector<Obstacle>& obstacles);

/// Reads the obstacles that write_obstacles() wrote, in their order. Throws Error where a value is invalid.
std::vector<Obstacle> read_obstacles(const Hdf5Reader& file);

}  // namespace samara
