#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "samara/internal/plot/axis_scale.hpp"
#include "samara/internal/plot/comparison_panels.hpp"

namespace samara {
namespace {

constexpr double gap = 55.0;
constexpr double margin_share = 0.04;
// Pixels between tics, and of their numbers.
constexpr double x_least = 95.0;
constexpr double x_widest = 85.0;
constexpr double z_least = 70.0;
constexpr double z_widest = 95.0;
constexpr std::size_t most_points = 4000;

/// A fall with its place among the lines that are drawn.
struct Line {
    const FallSeries* fall;
    unsigned color;
    double width;
};

/// Faint ones first, so that the strong lie on top.
std::vector<Line> lines_of(const Comparison& all) {
    std::vector<Line> lines;
    for (const FallSeries& fall : all.motion.more) lines.push_back({&fall, faint_motion_color, 1.2});
    for (const FallSeries& fall : all.reference.more) lines.push_back({&fall, faint_reference_color, 1.2});
    lines.push_back({&all.motion.example, motion_color, 3.0});
    lines.push_back({&all.reference.example, reference_color, 3.0});
    return lines;
}

std::string data_of(const std::vector<Line>& lines, double end, const std::array<AxisScale, 3>& scales) {
    fmt::memory_buffer data;
    auto out = std::back_inserter(data);
    for (std::size_t line = 0; line < lines.size(); ++line) {
        const FallSeries& fall = *lines[line].fall;
        fmt::format_to(out, "$way{} << EOD\n", line);
        const std::size_t stride = 1 + fall.times.size() / most_points;
        for (std::size_t i = 0; i < fall.times.size() && fall.times[i] <= end; i += stride) {
            const Vector3d& way = fall.ways[i];
            fmt::format_to(out, "{:.6g} {:.6g} {:.6g}\n", scales[0].number(way.x()),
                           scales[1].number(way.y()), scales[2].number(way.z()));
        }
        fmt::format_to(out, "EOD\n");
    }
    return fmt::to_string(data);
}

Range range_of(const std::vector<Line>& lines, double end, int axis) {
    Range range{0.0, 0.0};
    for (const Line& line : lines) {
        for (std::size_t i = 0; i < line.fall->times.size() && line.fall->times[i] <= end; ++i) {
            range.low = std::min(range.low, line.fall->ways[i][axis]);
            range.high = std::max(range.high, line.fall->ways[i][axis]);
        }
    }
    return range;
}

void grow(Range& range, double size) {
    const double middle = 0.5 * (range.low + range.high);
    range = {middle - 0.5 * size, middle + 0.5 * size};
}

/// The largest of 1, 2, 5, 10, ... by which the width may be stretched.
double stretch_for(double most) {
    double stretch = 1.0;
    for (const double next : {2.0, 5.0, 10.0, 20.0, 50.0, 100.0}) {
        if (next <= most) stretch = next;
    }
    return stretch;
}

std::string view_plot(const std::vector<Line>& lines, const Box& box, const Range& across,
                      const Range& height, int axis_index, double stretch,
                      const std::array<AxisScale, 3>& scales) {
    const bool first = axis_index == 0;
    const AxisScale& scale = scales[first ? 0 : 1];
    const Range numbers = scale.numbers(across);
    const Range heights = scales[2].numbers(height);
    std::string plot = place_frame(box);
    plot += axis("x", numbers, tic_step(numbers, box.right - box.left, x_least));
    plot += axis("y", heights, tic_step(heights, box.top - box.bottom, z_least));
    plot += first ? "set format y '%g'\n" : "set format y ''\n";
    plot += "set format x '%g'\n";
    const std::string title = scale.title(first ? "x" : "y");
    plot += x_title(stretch > 1.0 ? fmt::format("{}, stretched {:g}:1", title, stretch) : title, box);
    if (first) plot += height_title(scales[2], box);
    plot += bold_label(first ? "From the front" : "From the side", box.left, box.top + canvas::header_lift,
                       "left", black);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        plot += fmt::format("{} $way{} using {}:3 with lines lc rgb '#{:06x}' lw {} notitle",
                            i == 0 ? "plot" : ",", i, axis_index + 1, lines[i].color, lines[i].width);
    }
    return plot + "\nunset label\n";
}

}  // namespace

PanelText path_panel(const Comparison& comparison, double left, double right) {
    const std::vector<Line> lines = lines_of(comparison);
    const double end = drawn_time(comparison);
    std::array<Range, 2> across = {range_of(lines, end, 0), range_of(lines, end, 1)};
    Range height = range_of(lines, end, 2);
    const double tall = canvas::top - canvas::bottom;
    const double wide = 0.5 * (right - left - gap);
    const double widest = std::max(across[0].size(), across[1].size());
    const double margin = 1.0 + 2.0 * margin_share;
    const double pixel = std::max({margin * height.size() / tall, margin * widest / wide, 1e-9});
    const double stretch = widest > 0.0 ? stretch_for(pixel * wide / (margin * widest)) : 1.0;
    grow(height, pixel * tall);
    for (Range& range : across) grow(range, pixel * wide / stretch);
    const std::array<AxisScale, 3> scales = {axis_scale(across[0], wide, x_least, x_widest),
                                             axis_scale(across[1], wide, x_least, x_widest),
                                             axis_scale(height, tall, z_least, z_widest)};
    PanelText text;
    text.data = data_of(lines, end, scales);
    for (int axis_index = 0; axis_index < 2; ++axis_index) {
        const double edge = left + axis_index * (wide + gap);
        text.plots +=
            view_plot(lines, {edge, edge + wide, canvas::bottom, canvas::top},
                      across[static_cast<std::size_t>(axis_index)], height, axis_index, stretch, scales);
    }
    return text;
}

}  // namespace samara
