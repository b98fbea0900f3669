#include "samara/internal/plot/canvas.hpp"

#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "samara/core/base/printable.hpp"

namespace samara {

std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char letter : printable(text)) {
        if (letter == '\'') result += '\'';
        result += letter;
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

double tic_step(const Range& range, double pixels, double least) {
    const double smallest = least * range.size() / pixels;
    const auto tics = [&](double step) {
        return std::floor(range.high / step + 1e-9) - std::ceil(range.low / step - 1e-9) + 1.0;
    };
    double step = tic_step(smallest);
    if (tics(step) >= 2.0) return step;
    const double power = std::pow(10.0, std::floor(std::log10(smallest)));
    for (const double factor : {1.5, 2.5, 3.0, 4.0, 6.0, 7.5, 8.0, 12.0, 15.0}) {
        if (factor * power >= smallest && tics(factor * power) >= 2.0) return factor * power;
    }
    // Closer together than asked for, but two.
    while (tics(step) < 2.0) step = tic_step(0.4 * step);
    return step;
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
                       std::optional<double> title_share) {
    std::string marked = "{/:Bold ";
    for (const char letter : printable(text)) {
        if (std::string_view("\\{}^_@&~").find(letter) != std::string_view::npos) marked += '\\';
        marked += letter;
    }
    const std::string font = title_share ? fmt::format("title_font({:.4f})", *title_share) : "heading_font";
    return fmt::format("set label {} at screen {:.6f},{:.6f} {} font {} tc rgb '#{:06x}' enhanced front\n",
                       quoted(marked + '}'), x / canvas::width, y / canvas::height, align, font, color);
}

std::string x_title(const std::string& text, const Box& box) {
    return label(text, 0.5 * (box.left + box.right), box.bottom - 82.0, "center", black);
}

std::string terminal(bool as_svg) {
    // Type sizes are points in pngcairo and pixels in svg; svg draws larger dots.
    const auto size = [&](double pixels) { return as_svg ? pixels : 0.75 * pixels; };
    return fmt::format(
        "set terminal {} size {:.0f},{:.0f} font 'sans-serif,{:.6g}' background '#ffffff' enhanced\n"
        "heading_font = 'sans-serif,{:.6g}'; title_font(share) = sprintf('sans-serif,%.2f', share*{:.6g})\n"
        "dot_size = {}\n",
        as_svg ? "svg" : "pngcairo", canvas::width, canvas::height, size(canvas::heading_size),
        size(canvas::heading_size), size(canvas::title_size), as_svg ? 0.6 : 1.5);
}

}  // namespace samara
