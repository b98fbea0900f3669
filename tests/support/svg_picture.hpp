#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "support/text_extent.hpp"

namespace samara::test {

using Pixels = std::vector<Eigen::Vector2d>;

/// A line of text and where its ink is.
struct SvgText {
    std::string words;
    double size = 0.0;  ///< of its font
    PixelBox box;
};

/// What one element of a gnuplot command `plot` drew, without its sample in the key.
struct SvgCurve {
    std::string title;
    std::vector<Pixels> lines;  ///< joined where one begins at the end of the last
    Pixels marks;               ///< middles of points
    std::vector<Pixels> areas;
    std::optional<std::size_t> panel;  ///< none in a picture without frames
};

/// A picture as gnuplot's terminal svg writes it (pixels, y downwards). The terminal pngcairo draws from the
/// same commands: what holds for the one picture holds for the other, but for the height of a letter or two.
struct SvgPicture {
    PixelBox canvas;
    std::vector<PixelBox> panels;  ///< the frames on which borders are drawn
    std::vector<SvgText> texts;
    std::vector<SvgCurve> curves;
    std::vector<std::string> unreadable;  ///< coordinates that are no finite numbers
};

/// Reads gnuplot's own kinds of elements. Throws std::runtime_error for another file.
SvgPicture read_svg(const std::filesystem::path& file);

}  // namespace samara::test
