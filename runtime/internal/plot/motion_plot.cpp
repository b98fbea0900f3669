#include "samara/internal/plot/motion_plot.hpp"

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "samara/core/base/angles.hpp"
#include "samara/internal/plot/gnuplot.hpp"
#include "samara/internal/plot/heading.hpp"
#include "samara/internal/plot/series_panel.hpp"
#include "samara/internal/plot/strip_panel.hpp"

namespace samara {

std::string picture_title(const Motion& motion, const BodyMotion& body, int run, int copy,
                          const Measures& measures) {
    const bool rests = measures.rms_angular_speed == 0.0 && measures.mean_velocity.isZero(0.0);
    const std::string title = rests ? ": at rest"
                                    : fmt::format(": {}, {} at {:.3g} m/s", name_of(measures.regime),
                                                  measures.descent_speed < 0.0 ? "rises" : "descends",
                                                  std::abs(measures.descent_speed));
    std::string below;
    if (motion.runs > 1) below += fmt::format("run {} of {}  ·  ", run, motion.runs);
    if (body.copies > 1) below += fmt::format("copy {} of {}  ·  ", copy, body.copies);
    if (measures.frequency) below += fmt::format("{:.3g} Hz  ·  ", *measures.frequency);
    below +=
        fmt::format("inclination 95 % below {:.0f}°  ·  measured from {:.2f} s to {:.2f} s (shaded)",
                    degrees * measures.inclination_amplitude, measures.window.begin, measures.window.end);
    return heading({body.name, title, below});
}

MotionPlot plot_motion(const std::filesystem::path& file, const Motion& motion, const BodyMotion& body,
                       int run, int copy) {
    const Measures measures = measure(motion, body, run, copy);
    const Strip strip = choose_strip(motion, body, run, copy);
    const StripPanel left = strip_panel(motion, body, run, copy, strip);
    const SeriesPanel right = series_panel(motion, body, run, copy, strip, measures, left.right);
    draw_picture(file, left.data + right.data + "set multiplot\n" +
                           picture_title(motion, body, run, copy, measures) + left.plots + right.plots +
                           "unset multiplot\nset output\n");
    const auto time = [&](int frame) { return motion.times[static_cast<std::size_t>(frame)]; };
    return {static_cast<int>(strip.frames.size()), {time(strip.first), time(strip.last)}, measures};
}

}  // namespace samara
