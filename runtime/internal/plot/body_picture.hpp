#pragma once

#include <string>

#include "samara/internal/plot/canvas.hpp"

namespace samara {

/// The places of a body's four panels: `column` 0 or 1 from the left, `row` 0 or 1 from the top; whether the
/// upper ones have axes of their own.
Box quarter(int column, int row, bool own_axes);

/// What gnuplot plots for bars of standard errors in a block of x, y and error. Bars of its own would leave
/// out their middles.
std::string error_bars(const std::string& block, unsigned color);

/// A key: bold words in their colours in one line, set from the right.
class ColorKey {
  public:
    /// The line's right end and height (pixels).
    ColorKey(double right, double height) : right_(right), height_(height) {}
    /// The picture's own key, at the right of its second head line.
    ColorKey();
    /// gnuplot commands for one more word, to the left of those before.
    std::string add(const std::string& word, unsigned color);

  private:
    double right_;
    double height_;
};

/// The colours of what a body's pictures tell apart (Okabe and Ito's palette).
inline constexpr unsigned body_colors[] = {0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7, 0xe69f00};

}  // namespace samara
