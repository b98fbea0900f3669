#include "samara/internal/plot/axis_scale.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "samara/internal/plot/heading.hpp"

namespace samara {
namespace {

constexpr double plain_share = 0.92;  // figures in plain type over those in bold type
constexpr double picture_left = 45.0;
constexpr double line_height = 33.0;

std::string superscript(int number) {
    constexpr const char* figures[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = number < 0 ? "⁻" : "";
    for (const char figure : std::to_string(std::abs(number))) text += figures[figure - '0'];
    return text;
}

AxisScale with_power(double origin, double largest) {
    const int exponent = 3 * static_cast<int>(std::floor(std::log10(largest) / 3.0));
    return {origin, exponent, std::pow(10.0, exponent)};
}

/// Whether the axis' numbers, as gnuplot writes them, are narrow enough and say where the tics are.
bool numbers_fit(const Range& numbers, double pixels, double least, double widest) {
    const double step = tic_step(numbers, pixels, least);
    for (double count = std::ceil(numbers.low / step); count * step <= numbers.high; count += 1.0) {
        const std::string text = fmt::format("{:.6g}", count * step);
        if (text.find('e') != std::string::npos) return false;
        if (std::abs(std::stod(text) - count * step) > 1e-3 * step) return false;
        if (plain_share * text_width(text, canvas::heading_size) > widest) return false;
    }
    return true;
}

}  // namespace

std::string AxisScale::title(const std::string& name) const {
    std::string text = name;
    if (origin != 0.0) text += fmt::format(" {} {:.12g}", origin < 0.0 ? "+" : "−", std::abs(origin));
    return text + (exponent == 0 ? " (m)" : fmt::format(" (10{} m)", superscript(exponent)));
}

AxisScale axis_scale(const Range& range, double pixels, double least, double widest) {
    const double size = range.size();
    if (!(size > 0.0)) return {};
    const double step = std::pow(10.0, std::ceil(std::log10(size)));
    const double origin = step * std::round(0.5 * (range.low + range.high) / step);
    const double largest = std::max(std::abs(range.low), std::abs(range.high));
    const AxisScale last = with_power(origin, size);
    for (const AxisScale& scale : {AxisScale{}, with_power(0.0, largest), AxisScale{origin, 0, 1.0}}) {
        if (numbers_fit(scale.numbers(range), pixels, least, widest)) return scale;
    }
    return last;
}

std::string height_title(const AxisScale& scale, const Box& box) {
    const std::string title = scale.title("z");
    const double y = box.top + canvas::header_lift;
    if (scale.origin == 0.0 && scale.exponent == 0) return label(title, box.left - 12.0, y, "right", black);
    return label(title, picture_left, y + line_height, "left", black);
}

}  // namespace samara
