#pragma once

#include <optional>
#include <string>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/motion/motion.hpp"
#include "samara/motion/selection.hpp"

namespace samara {

/// Returns the body of this name, or the first where the name is empty. Throws Error, which names the file
/// `input` and the bodies there are, where there is none.
const BodyMotion& find_body(const std::string& input, const Motion& motion, const std::string& name);

/// Throws Error where the motion of the file `input` has no such run.
void require_run(const std::string& input, const Motion& motion, int run);

/// Throws Error where the body in the file `input` has no such copy.
void require_copy(const std::string& input, const BodyMotion& body, int copy);

/// Returns the copies of an option's words "N" or "N-M", each counted from 0. Throws Error, which names the
/// option, where they are neither.
CopyRange copy_range(const std::string& option, const std::string& words);

/// Returns the colours (red, green and blue from 0 to 1, linear) of an option's words "rrggbb,rrggbb,...",
/// sRGB in hexadecimal, with or without "#" before each. Throws Error, which names the option, where they are
/// not.
std::vector<Vector3d> colors_of_words(const std::string& option, const std::string& words);

/// Returns the vector of an option's words "x,y,z"; nothing where they are not three finite numbers.
std::optional<Vector3d> vector_of_words(const std::string& words);

}  // namespace samara
