#pragma once

#include <filesystem>
#include <string>

#include "samara/motion/motion.hpp"

namespace samara {

/// Returns the name of the group of a body's uncertainties in a motion file: below it stands one group for
/// each cause, which holds a number for each metric.
std::string uncertainty_group(const std::string& body);

/// Throws Error, naming the file, where a motion apart from its poses breaks a rule of read_motion_file that
/// a single dataset does not show.
void check_motion_but_poses(const std::filesystem::path& file, const Motion& motion);

/// Throws Error, naming the file, where some or all poses of a body break a rule of read_motion_file.
void check_poses(const std::filesystem::path& file, const std::string& body, const std::vector<Pose>& poses);

/// Throws Error, naming the file, where a motion or its poses break a rule of read_motion_file, or where
/// there is not one pose for each run, frame and copy.
void check_motion(const std::filesystem::path& file, const Motion& motion);

}  // namespace samara
