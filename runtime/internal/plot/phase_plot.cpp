#include "samara/internal/plot/phase_plot.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "samara/analysis/metrics/tilt.hpp"
#include "samara/core/base/angles.hpp"
#include "samara/core/base/error.hpp"
#include "samara/internal/plot/gnuplot.hpp"
#include "samara/internal/plot/motion_plot.hpp"
#include "samara/internal/plot/panel.hpp"
#include "samara/internal/plot/silhouette.hpp"
#include "samara/motion/inclination.hpp"

namespace samara {
namespace {

constexpr Box portrait = {140.0, 1125.0, canvas::bottom, canvas::top};
constexpr double series_left = 1270.0;
constexpr double right_edge = canvas::width - 45.0;
constexpr double gap = 100.0;
constexpr double smooth_swing = 12.0;  // frames: of fewer the curve is seen to have corners

Range even_range(double largest) {
    const double most = largest > 1e-9 ? 1.08 * largest : 1.0;
    return {-most, most};
}

double largest_of(const std::vector<double>& values) {
    double largest = 0.0;
    for (const double value : values) largest = std::max(largest, std::abs(value));
    return largest;
}

/// Rows of time, angle (degrees), rate (rad/s) and colour; an empty line where the curve breaks.
std::string data_of(const Tilt& tilt, int& lines) {
    std::string data = "$phase << EOD\n";
    const double length = tilt.times.back() - tilt.times.front();
    for (std::size_t i = 0; i < tilt.times.size(); ++i) {
        if (!tilt.continues[i]) {
            ++lines;
            if (i > 0) data += '\n';
        }
        const double share = length > 0.0 ? (tilt.times[i] - tilt.times.front()) / length : 0.0;
        data += fmt::format("{:.7g} {:.6g} {:.6g} {}\n", tilt.times[i], degrees * tilt.angle[i], tilt.rate[i],
                            packed(time_color(share)));
    }
    return data + fmt::format("EOD\n$start << EOD\n{:.6g} {:.6g}\nEOD\n", degrees * tilt.angle.front(),
                              tilt.rate.front());
}

/// "0.00 s" to "4.00 s" above the portrait, in their colours.
std::string time_key(const TimeWindow& fall) {
    const double y = portrait.top + canvas::header_lift;
    std::string key;
    for (int i = 0; i <= 2; ++i) {
        const double share = 0.5 * i;
        key += label(fmt::format("{:.2f} s", fall.begin + share * (fall.end - fall.begin)),
                     portrait.right - 130.0 * (2 - i), y, "right", packed(0.9 * time_color(share)));
    }
    return key;
}

PanelAxis angle_axis(const Tilt& tilt, const std::string& title) {
    const double largest = degrees * largest_of(tilt.angle);
    if (largest <= 60.0) return {even_range(largest), title, 0.0};
    return {{-92.0, 92.0}, title, 30.0};
}

/// All rates but those of the few frames in which the axis lies across the plane.
PanelAxis rate_axis(const Tilt& tilt, const std::string& title) {
    std::vector<double> rates;
    for (const double rate : tilt.rate) rates.push_back(std::abs(rate));
    return {even_range(std::min(largest_of(rates), 1.25 * percentile(rates, 99.0))), title, 0.0};
}

std::string portrait_plot(const Tilt& tilt, const TimeWindow& fall) {
    std::string plot = begin_panel(portrait, angle_axis(tilt, "tilt in the plane of the swing (°)"),
                                   rate_axis(tilt, "Rate of the tilt (rad/s)"));
    plot += time_key(fall);
    plot +=
        "set arrow from graph 0, first 0 to graph 1, first 0 nohead back lc rgb '#b0b0b0' lw 1.5\n"
        "set arrow from first 0, graph 0 to first 0, graph 1 nohead back lc rgb '#b0b0b0' lw 1.5\n"
        "plot $phase using 2:3:4 with lines lw 2.5 lc rgb variable notitle, $start using 1:2 with points pt "
        "6 "
        "ps 2*dot_size lw 3 lc rgb '#1a1a1a' notitle\n";
    return plot + end_panel();
}

std::string series_plot(const Tilt& tilt, const PhasePlot& shown, int column) {
    const TimeWindow& fall = shown.fall;
    const bool upper = column == 2;
    const double tall = 0.5 * (canvas::top - canvas::bottom - gap);
    const double bottom = upper ? canvas::top - tall : canvas::bottom;
    const Range times =
        fall.end > fall.begin ? Range{fall.begin, fall.end} : Range{fall.begin - 0.5, fall.begin + 0.5};
    const PanelAxis up = upper ? angle_axis(tilt, "Tilt (°)") : rate_axis(tilt, "Rate (rad/s)");
    std::string aside;
    if (upper && shown.frames_in_swing && *shown.frames_in_swing < smooth_swing) {
        aside = fmt::format("{:.2g} frames a swing: raise frame_rate", *shown.frames_in_swing);
    } else if (!upper && shown.highest_rate > up.range.high) {
        aside = fmt::format("not shown: up to {:.3g}", shown.highest_rate);
    }
    std::string plot = begin_panel({series_left, right_edge, bottom, bottom + tall},
                                   {times, upper ? "" : "time (s)", 0.0}, up, aside);
    plot += shaded_window(shown.measures.window);
    plot += fmt::format("plot $phase using 1:{}:4 with {} lw 2.5 lc rgb variable notitle\n", column,
                        fall.end > fall.begin ? "lines" : "points pt 7 ps dot_size");
    return plot + end_panel();
}

}  // namespace

PhasePlot plot_phase(const std::filesystem::path& file, const Motion& motion, const BodyMotion& body, int run,
                     int copy) {
    if (!has_shortest_axis(body.surface)) {
        throw Error(
            fmt::format("'{}' has no shortest axis, whose tilt a phase portrait shows: draw it "
                        "with --kind strip",
                        body.name));
    }
    const Tilt tilt = tilt_of(motion, body, run, copy);
    PhasePlot shown;
    shown.fall = {tilt.times.front(), tilt.times.back()};
    shown.highest_rate = largest_of(tilt.rate);
    shown.measures = measure(motion, body, run, copy);
    if (const auto& frequency = shown.measures.frequency; frequency && *frequency > 0.0) {
        shown.frames_in_swing = 0.5 / *frequency * motion.frame_rate;
    }
    std::string script = data_of(tilt, shown.lines) + "set multiplot\n";
    script += picture_title(motion, body, run, copy, shown.measures);
    script += portrait_plot(tilt, shown.fall);
    script += series_plot(tilt, shown, 2) + series_plot(tilt, shown, 3);
    draw_picture(file, script + "unset multiplot\nset output\n");
    return shown;
}

}  // namespace samara
