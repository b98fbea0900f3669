#pragma once

#include <string>

#include "samara/internal/plot/canvas.hpp"

namespace samara {

/// How lengths along an axis are written so that their numbers stay short: less an origin, where they differ
/// by little of their size, and in units of a power of ten, where they are very large or small.
struct AxisScale {
    double origin = 0.0;  ///< m
    int exponent = 0;     ///< of ten, a multiple of three
    double unit = 1.0;    ///< m: that power

    /// The number of a length (m).
    [[nodiscard]] double number(double length) const { return (length - origin) / unit; }
    [[nodiscard]] Range numbers(const Range& lengths) const {
        return {number(lengths.low), number(lengths.high)};
    }
    /// "x (m)", "x − 54320 (m)", "x (10⁶ m)".
    [[nodiscard]] std::string title(const std::string& name) const;
};

/// The simplest scale for an axis over the range (m) of that many pixels, tics at least `least` pixels apart,
/// by which all numbers are told apart and none is wider than `widest` pixels.
AxisScale axis_scale(const Range& range, double pixels, double least, double widest);

/// A gnuplot command for the title of the vertical axis "z": beside the head of a panel that begins at
/// `box.left`, or above it where it is long.
std::string height_title(const AxisScale& scale, const Box& box);

}  // namespace samara
