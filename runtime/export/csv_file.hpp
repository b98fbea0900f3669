#pragma once

#include <filesystem>
#include <optional>

#include "samara/export/export_progress.hpp"
#include "samara/motion/motion.hpp"

namespace samara {

/// Writes a motion as a table of comma-separated values (RFC 4180, UTF-8, lines ended by "\n"): a row of
/// column names, then one row for each run, body, copy and frame, the last one running fastest:
///
///   run,body,copy,time,position_{x,y,z},orientation_{w,x,y,z},velocity_{x,y,z},angular_velocity_{x,y,z}
///
/// Runs and copies count from 0, copies from `first_copy`, the number of the motion's first; time is in s.
/// Position (m) is that of the shape file's origin, and velocity (m/s) is the velocity of that point, v +
/// omega x (origin - centre of mass): the derivative of the position. A body's name is printable(), and one
/// that begins with = + - or @ has an apostrophe before it, so that no spreadsheet takes it for a formula.
/// Orientation is the unit quaternion from shape to world axes, with continuous signs, and angular velocity
/// (rad/s) is in world axes. Numbers are the shortest text that reads back as the same double. Returns the
/// number of rows below the names. Writes run `run` alone where one is given, which must be in the motion.
/// Throws Error where the file cannot be written.
std::size_t write_csv(const std::filesystem::path& file, const Motion& motion,
                      const std::optional<int>& run = std::nullopt, const ExportProgress& progress = {},
                      int first_copy = 0);

}  // namespace samara
