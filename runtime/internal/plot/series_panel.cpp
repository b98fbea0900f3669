#include "samara/internal/plot/series_panel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "samara/core/base/angles.hpp"
#include "samara/internal/plot/heading.hpp"
#include "samara/internal/plot/panel.hpp"
#include "samara/internal/plot/silhouette.hpp"
#include "samara/internal/plot/strip_panel.hpp"
#include "samara/motion/inclination.hpp"

namespace samara {
namespace {

constexpr double tic_labels = 110.0;
constexpr double right_edge = canvas::width - 45.0;
constexpr double gap = 95.0;
constexpr int panels = 3;

/// What is shown, frame by frame.
struct Series {
    std::vector<double> times;          // s
    std::size_t first = 0;              // frame, the one at the first of the times
    std::vector<double> descent_speed;  // m/s
    std::vector<double> inclination;    // degrees
    std::vector<Vector3d> spin;         // rad/s
};

/// The fall and a little before and after it: a body may wait long, and lie long on the ground.
TimeWindow shown_time(const Motion& motion, const BodyMotion& body, int run, int copy) {
    const TimeWindow fall = fall_of(motion, body, run, copy);
    const double length = fall.end - fall.begin;
    return {std::max(motion.times.front(), fall.begin - 0.1 * length),
            std::min(motion.times.back(), fall.end + 0.25 * length)};
}

Series series_of(const Motion& motion, const BodyMotion& body, int run, int copy) {
    const Vector3d down = down_direction(motion.gravity);
    const TimeWindow shown = shown_time(motion, body, run, copy);
    Series series;
    for (int frame = 0; frame < motion.frames(); ++frame) {
        const double time = motion.times[static_cast<std::size_t>(frame)];
        if (time < shown.begin) ++series.first;
        if (time < shown.begin || time > shown.end) continue;
        series.times.push_back(time);
        const Pose& pose = motion.pose(body, run, frame, copy);
        series.descent_speed.push_back(pose.velocity.dot(down));
        series.inclination.push_back(degrees * inclination(motion, body, pose));
        series.spin.push_back(pose.angular_velocity);
    }
    return series;
}

std::string series_data(const Motion& motion, const Strip& strip, const Series& series) {
    const auto row = [&](std::size_t i) {
        return fmt::format("{:.7g} {:.7g} {:.7g} {:.7g} {:.7g} {:.7g}", series.times[i],
                           series.descent_speed[i], series.inclination[i], series.spin[i].x(),
                           series.spin[i].y(), series.spin[i].z());
    };
    std::string data = "$series << EOD\n";
    for (std::size_t i = 0; i < series.times.size(); ++i) data += row(i) + '\n';
    data += "EOD\n$dots << EOD\n";
    for (const int frame : strip.frames) {
        data += fmt::format("{} {}\n", row(static_cast<std::size_t>(frame) - series.first),
                            packed(time_color(share_of(motion, strip, frame))));
    }
    return data + "EOD\n";
}

/// The range of the values with some air, and zero where it is near.
Range range_of(const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    Range range = {std::min(*low, 0.0), std::max(*high, 0.0)};
    const double size = range.size() > 1e-12 ? range.size() : 2.0;
    if (range.high > 0.0 || size == 2.0) range.high += 0.1 * size;
    if (range.low < 0.0 || size == 2.0) range.low -= 0.1 * size;
    return range;
}

Range time_range(const Series& series) {
    const double first = series.times.front();
    return series.times.size() > 1 ? Range{first, series.times.back()} : Range{first - 0.5, first + 0.5};
}

Box panel_box(double left, int index) {
    const double tall = (canvas::top - canvas::bottom - (panels - 1) * gap) / panels;
    const double top = canvas::top - index * (tall + gap);
    return {left + tic_labels, right_edge, top - tall, top};
}

/// A dashed line at a value over the window.
std::string level(const Measures& measures, double value) {
    return fmt::format(
        "set arrow from {:.9g},{:.9g} to {:.9g},{:.9g} nohead lc rgb '#d55e00' lw 2.5 dt (8,6)\n",
        measures.window.begin, value, measures.window.end, value);
}

std::string scalar_plot(int column) {
    return fmt::format(
        "plot $series using 1:{0} with lines lc rgb '#333333' lw 2.5 notitle, $dots using 1:{0}:7 with "
        "points "
        "pt 7 ps dot_size lc rgb variable notitle\n",
        column);
}

/// One line for each component, a dot where it is of one frame alone, named in the header, left of the text
/// at its right, in the line's colour (Okabe and Ito's palette).
std::string component_plots(const Series& series, const Box& box, const std::string& right) {
    constexpr std::array<unsigned, 3> colors = {0xd55e00, 0x009e73, 0x0072b2};
    constexpr std::array<const char*, 3> names = {"x", "y", "z"};
    const char* style = series.times.size() > 1 ? "lines" : "points pt 7 ps dot_size";
    constexpr double apart = 38.0;
    const double last = box.right - std::max(164.0, text_width(right, canvas::heading_size) + apart);
    std::string labels;
    std::string plots;
    for (std::size_t i = 0; i < 3; ++i) {
        labels += bold_label(names[i], last - apart * static_cast<double>(2 - i),
                             box.top + canvas::header_lift, "center", colors[i]);
        plots += fmt::format("{} $series using 1:{} with {} lc rgb '#{:06x}' lw 2.5 notitle",
                             i == 0 ? "plot" : ",", i + 4, style, colors[i]);
    }
    return labels + plots + '\n';
}

}  // namespace

SeriesPanel series_panel(const Motion& motion, const BodyMotion& body, int run, int copy, const Strip& strip,
                         const Measures& measures, double left) {
    const Series series = series_of(motion, body, run, copy);
    const Range times = time_range(series);
    SeriesPanel panel;
    panel.data = series_data(motion, strip, series);
    const auto begin = [&](const Box& box, const PanelAxis& up, const std::string& right, bool last) {
        panel.plots += begin_panel(box, {times, last ? "time (s)" : "", 0.0}, up, right);
        panel.plots += shaded_window(measures.window);
    };

    begin(panel_box(left, 0), {range_of(series.descent_speed), "Descent speed (m/s)", 0.0},
          fmt::format("mean {:.3g}", measures.descent_speed), false);
    panel.plots += level(measures, measures.descent_speed) + scalar_plot(2) + end_panel();

    const double steepest = *std::max_element(series.inclination.begin(), series.inclination.end());
    const Range angles = {0.0, steepest > 60.0 ? 90.0 : std::max(10.0, 10.0 * std::ceil(0.105 * steepest))};
    begin(panel_box(left, 1), {angles, "Inclination (°)", angles.high > 60.0 ? 30.0 : 10.0},
          fmt::format("mean {:.1f}, 95 % below {:.1f}", degrees * measures.mean_inclination,
                      degrees * measures.inclination_amplitude),
          false);
    panel.plots += level(measures, degrees * measures.mean_inclination) + scalar_plot(3) + end_panel();

    std::vector<double> components;
    for (const Vector3d& spin : series.spin) components.insert(components.end(), spin.begin(), spin.end());
    const Box box = panel_box(left, 2);
    const std::string right = fmt::format("rms {:.3g}", measures.rms_angular_speed);
    begin(box, {range_of(components), "Angular velocity (rad/s)", 0.0}, right, true);
    panel.plots += component_plots(series, box, right) + end_panel();
    return panel;
}

}  // namespace samara
