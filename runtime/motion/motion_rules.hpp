#pragma once

#include <filesystem>
#include <string>

#include "samara/motion/motion.hpp"

namespace samara {

/// The group of a body's uncertainties in a motion file: below it one for each cause, which holds a number
/// for each figure.
std::string uncertainty_group(const std::string& body);

/// Throws Error, naming the file, where all of a motion but its poses breaks a rule of read_motion_file that
/// a single dataset does not show.
void check_motion_but_poses(const std::filesystem::path& file, const Motion& motion);

/// The same for poses of a body, some or all.
void check_poses(const std::filesystem::path& file, const std::string& body, const std::vector<Pose>& poses);

/// Both, and that there is one pose for each run, frame and copy.
void check_motion(const std::filesystem::path& file, const Motion& motion);

}  // namespace samara
