#pragma once

#include <optional>
#include <string>

namespace samara {

/// The picture's size and its type sizes, in pixels.
namespace canvas {
inline constexpr double width = 2000.0;
inline constexpr double height = 1300.0;
inline constexpr double bottom = 110.0;       ///< lower edge of all panels
inline constexpr double top = 1095.0;         ///< upper edge of all panels
inline constexpr double text_size = 26.0;     ///< height of a line of plain text
inline constexpr double heading_size = 24.0;  ///< font size of all texts but the title
inline constexpr double title_size = 37.5;
inline constexpr double header_lift = 30.0;  ///< from a panel's upper edge to the middle of its header
}  // namespace canvas

/// A rectangle of the picture (pixels from the lower left corner).
struct Box {
    double left = 0.0;
    double right = 0.0;
    double bottom = 0.0;
    double top = 0.0;
};

/// An interval of an axis.
struct Range {
    double low = 0.0;
    double high = 1.0;

    [[nodiscard]] double size() const { return high - low; }
};

/// The text, made printable(), in gnuplot's single quotes.
std::string quoted(const std::string& text);

/// The smallest of 1, 2 and 5 times a power of ten that is not below `least` (> 0): a step between tics.
double tic_step(double least);

/// A step between the tics of an axis that is `pixels` long, `least` pixels or more where that leaves at
/// least two tics, off which alone a scale can be read.
double tic_step(const Range& range, double pixels, double least);

/// gnuplot commands that put the next plot's frame on the box.
std::string place_frame(const Box& box);

/// A gnuplot command that sets the range of an axis, "x" or "y", with a tic at each multiple of `step`.
std::string axis(const char* name, const Range& range, double step);

/// A gnuplot command for a line of text at a place in pixels; `align`: left, center or right; `color`:
/// 0xRRGGBB. The text is shown as it is.
std::string label(const std::string& text, double x, double y, const char* align, unsigned color);

/// The same in bold type; with `title_share` in the title's font at that share of its size.
std::string bold_label(const std::string& text, double x, double y, const char* align, unsigned color,
                       std::optional<double> title_share = {});

/// A gnuplot command for the title of the horizontal axis of the frame on the box.
std::string x_title(const std::string& text, const Box& box);

/// gnuplot commands that choose the terminal and define the font heading_font, the function title_font of a
/// share of its size, and the size dot_size of points, so that .png and .svg look the same.
std::string terminal(bool as_svg);

inline constexpr unsigned black = 0x1a1a1a;
inline constexpr unsigned gray = 0x6b6b6b;

}  // namespace samara
