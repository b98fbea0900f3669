#include "samara/plot/canvas.hpp"

#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace samara {

std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char letter : text) {
        if (letter == '\'') result += '\'';
        result += letter == '\n' ? ' ' : letter;
    }
    return result + '\'';
}

double tic_step(double least) {
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= least * (1.0 - 1e-9)) return factor * power;
    }
    return 10.0 * power;
}

std::string place_frame(const Box& box) {
    return fmt::format(
        "set lmargin at screen {:.6f}; set rmargin at screen {:.6f}; set bmargin at screen {:.6f}; set "
        "tmargin "
        "at screen {:.6f}\n",
        box.left / canvas::width, box.right / canvas::width, box.bottom / canvas::height,
        box.top / canvas::height);
}

std::string axis(const char* name, const Range& range, double step) {
    return fmt::format("set {0}range [{1:.9g}:{2:.9g}]; set {0}tics {3:.9g}\n", name, range.low, range.high,
                       step);
}

std::string label(const std::string& text, double x, double y, const char* align, unsigned color) {
    return fmt::format("set label {} at screen {:.6f},{:.6f} {} tc rgb '#{:06x}' noenhanced front\n",
                       quoted(text), x / canvas::width, y / canvas::height, align, color);
}

std::string bold_label(const std::string& text, double x, double y, const char* align, unsigned color,
                       const char* font) {
    std::string marked = "{/:Bold ";
    for (const char letter : text) {
        if (std::string_view("\\{}^_@&~").find(letter) != std::string_view::npos) marked += '\\';
        marked += letter;
    }
    return fmt::format("set label {} at screen {:.6f},{:.6f} {} font {} tc rgb '#{:06x}' enhanced front\n",
                       quoted(marked + '}'), x / canvas::width, y / canvas::height, align, font, color);
}

std::string x_title(const std::string& text, const Box& box) {
    return label(text, 0.5 * (box.left + box.right), box.bottom - 82.0, "center", black);
}

std::string terminal(bool as_svg) {
    // Type sizes are points in pngcairo and pixels in svg; svg draws larger dots.
    const int points = 18;
    const int title_points = 28;
    const auto size = [&](int value) { return as_svg ? value * 4 / 3 : value; };
    return fmt::format(
        "set terminal {} size {:.0f},{:.0f} font 'sans-serif,{}' background '#ffffff' enhanced\n"
        "heading_font = 'sans-serif,{}'; title_font = 'sans-serif,{}'; dot_size = {}\n",
        as_svg ? "svg" : "pngcairo", canvas::width, canvas::height, size(points), size(points),
        size(title_points), as_svg ? 0.6 : 1.5);
}

}  // namespace samara
