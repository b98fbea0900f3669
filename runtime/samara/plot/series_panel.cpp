#include "samara/plot/series_panel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "samara/motion/inclination.hpp"
#include "samara/plot/panel.hpp"
#include "samara/plot/silhouette.hpp"
#include "samara/plot/strip_panel.hpp"

namespace samara {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;
constexpr double tic_labels = 110.0;
constexpr double right_edge = canvas::width - 45.0;
constexpr double gap = 95.0;
constexpr int panels = 3;

struct Series {
    std::vector<double> descent_speed;  // m/s
    std::vector<double> inclination;    // degrees
    std::vector<Vector3d> spin;         // rad/s
};

Series series_of(const Motion& motion, const BodyMotion& body, int run, int copy) {
    const Vector3d down = down_direction(motion.gravity);
    Series series;
    for (int frame = 0; frame < motion.frames(); ++frame) {
        const Pose& pose = motion.pose(body, run, frame, copy);
        series.descent_speed.push_back(pose.velocity.dot(down));
        series.inclination.push_back(degrees * inclination(motion, body, pose));
        series.spin.push_back(pose.angular_velocity);
    }
    return series;
}

std::string series_data(const Motion& motion, const Strip& strip, const Series& series) {
    const auto row = [&](std::size_t i) {
        return fmt::format("{:.7g} {:.7g} {:.7g} {:.7g} {:.7g} {:.7g}", motion.times[i],
                           series.descent_speed[i], series.inclination[i], series.spin[i].x(),
                           series.spin[i].y(), series.spin[i].z());
    };
    std::string data = "$series << EOD\n";
    for (std::size_t i = 0; i < motion.times.size(); ++i) data += row(i) + '\n';
    data += "EOD\n$dots << EOD\n";
    for (const int frame : strip.frames) {
        data += fmt::format("{} {}\n", row(static_cast<std::size_t>(frame)),
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

Range time_range(const Motion& motion) {
    if (motion.times.size() > 1) return {motion.times.front(), motion.times.back()};
    return {motion.times.front() - 0.5, motion.times.front() + 0.5};
}

Box panel_box(double left, int index) {
    const double tall = (canvas::top - canvas::bottom - (panels - 1) * gap) / panels;
    const double top = canvas::top - index * (tall + gap);
    return {left + tic_labels, right_edge, top - tall, top};
}

/// Frame, axes, header and the shaded window of a panel; the plot command follows. `y_step`: between tics, 0
/// for a round step.
std::string begin_panel(const Motion& motion, const Measures& measures, const Box& box, const Range& range,
                        const std::string& title, bool last, double y_step = 0.0) {
    const double tall = box.top - box.bottom;
    const Range times = time_range(motion);
    std::string text = place_frame(box);
    text += axis("x", times, tic_step(90.0 * times.size() / (box.right - box.left)));
    text += axis("y", range, y_step > 0.0 ? y_step : tic_step(50.0 * range.size() / tall));
    text += last ? "set format x '%g'\n" : "set format x ''\n";
    if (last) text += x_title("time (s)", box);
    text += "set format y '%g'\n";
    text += shaded_window(measures.window);
    return text + bold_label(title, box.left, box.top + canvas::header_lift, "left", black);
}

std::string right_header(const std::string& text, const Box& box) {
    return label(text, box.right, box.top + canvas::header_lift, "right", gray);
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

/// One line for each component, named in the header in the line's colour (Okabe and Ito's palette).
std::string component_plots(const Box& box) {
    constexpr std::array<unsigned, 3> colors = {0xd55e00, 0x009e73, 0x0072b2};
    constexpr std::array<const char*, 3> names = {"x", "y", "z"};
    std::string labels;
    std::string plots;
    for (std::size_t i = 0; i < 3; ++i) {
        labels += bold_label(names[i], box.right - 240.0 + 38.0 * static_cast<double>(i),
                             box.top + canvas::header_lift, "center", colors[i]);
        plots += fmt::format("{} $series using 1:{} with lines lc rgb '#{:06x}' lw 2.5 notitle",
                             i == 0 ? "plot" : ",", i + 4, colors[i]);
    }
    return labels + plots + '\n';
}

}  // namespace

SeriesPanel series_panel(const Motion& motion, const BodyMotion& body, int run, int copy, const Strip& strip,
                         const Measures& measures, double left) {
    const Series series = series_of(motion, body, run, copy);
    SeriesPanel panel;
    panel.data = series_data(motion, strip, series);

    Box box = panel_box(left, 0);
    panel.plots +=
        begin_panel(motion, measures, box, range_of(series.descent_speed), "Descent speed (m/s)", false);
    panel.plots += right_header(fmt::format("mean {:.3g}", measures.descent_speed), box);
    panel.plots += level(measures, measures.descent_speed) + scalar_plot(2) + end_panel();

    box = panel_box(left, 1);
    const double steepest = *std::max_element(series.inclination.begin(), series.inclination.end());
    const Range angles = {0.0, steepest > 60.0 ? 90.0 : std::max(10.0, 10.0 * std::ceil(0.105 * steepest))};
    panel.plots +=
        begin_panel(motion, measures, box, angles, "Inclination (°)", false, angles.high > 60.0 ? 30.0 : 0.0);
    panel.plots +=
        right_header(fmt::format("mean {:.1f}, 95 % below {:.1f}", degrees * measures.mean_inclination,
                                 degrees * measures.inclination_amplitude),
                     box);
    panel.plots += level(measures, degrees * measures.mean_inclination) + scalar_plot(3) + end_panel();

    box = panel_box(left, 2);
    std::vector<double> components;
    for (const Vector3d& spin : series.spin) components.insert(components.end(), spin.begin(), spin.end());
    panel.plots += begin_panel(motion, measures, box, range_of(components), "Angular velocity (rad/s)", true);
    panel.plots += right_header(fmt::format("rms {:.3g}", measures.rms_angular_speed), box);
    panel.plots += component_plots(box);
    panel.plots += end_panel();
    return panel;
}

}  // namespace samara
