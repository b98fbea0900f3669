#pragma once

#include <string>
#include <vector>

#include "support/svg_picture.hpp"

namespace samara::test {

/// What cannot be read off a picture as it should, a line each; none in a good one:
/// - coordinates that are no finite numbers, and numbers such as "nan" among the texts;
/// - texts that overlap, leave the picture, lie across a panel's frame, or under a curve's points;
/// - curves that leave their panel's frame, or are cut off at it: a line that ends on the frame where it has
///   no point, or, drawn without points, in the middle of its course or beside an axis's last number; an area
///   with a side along the frame;
/// - panels without a curve that can be seen;
/// - axes with one number alone, off which no scale can be read.
std::vector<std::string> faults_of(const SvgPicture& picture);

}  // namespace samara::test
