#pragma once

#include <string>

#include <Eigen/Geometry>

namespace samara::test {

using PixelBox = Eigen::AlignedBox2d;

/// The ink of a line of text in DejaVu Sans, the font of the pictures on Debian: about the pen's start on the
/// baseline, y downwards, in the unit of `size` (the font's size). `width`: how far the pen moves.
struct TextExtent {
    PixelBox ink;  ///< empty where the text is blank
    double width = 0.0;
};

/// Of a UTF-8 text, by the font's own metrics, without kerning.
TextExtent text_extent(const std::string& text, double size, bool bold);

}  // namespace samara::test
