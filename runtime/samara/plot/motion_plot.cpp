#include "samara/plot/motion_plot.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "samara/base/content_hash.hpp"
#include "samara/base/error.hpp"
#include "samara/command/subprocess.hpp"
#include "samara/files/replace_file.hpp"
#include "samara/files/temporary_folder.hpp"
#include "samara/plot/series_panel.hpp"
#include "samara/plot/strip_panel.hpp"

namespace samara {
namespace {

std::string preamble(bool as_svg) {
    return "set encoding utf8\nset minussign\n" + terminal(as_svg) +
           "set output ARG1\n"
           "set border 3 lw 1.5 lc rgb '#808080'\n"
           "set tics nomirror out scale 0.6 textcolor rgb '#1a1a1a'\n"
           "set grid lw 1 lt 1 lc rgb '#e4e4e4'\n"
           "unset key\n";
}

std::string title_of(const Motion& motion, const BodyMotion& body, int run, int copy,
                     const Measures& measures) {
    const double degrees = 180.0 / std::numbers::pi;
    const bool rests = measures.rms_angular_speed == 0.0 && measures.mean_velocity.isZero(0.0);
    const std::string title = rests ? body.name + ": at rest"
                                    : fmt::format("{}: {}, descends at {:.3g} m/s", body.name,
                                                  name_of(measures.regime), measures.descent_speed);
    std::string below;
    if (motion.runs > 1) below += fmt::format("run {} of {}  ·  ", run, motion.runs);
    if (body.copies > 1) below += fmt::format("copy {} of {}  ·  ", copy, body.copies);
    if (measures.frequency) below += fmt::format("{:.3g} Hz  ·  ", *measures.frequency);
    below +=
        fmt::format("inclination 95 % below {:.0f}°  ·  measured from {:.2f} s to {:.2f} s (shaded)",
                    degrees * measures.inclination_amplitude, measures.window.begin, measures.window.end);
    return bold_label(title, 45.0, canvas::height - 55.0, "left", black, "title_font") +
           label(below, 45.0, canvas::height - 108.0, "left", gray);
}

std::string last_line(const std::string& text) {
    const std::size_t end = text.find_last_not_of(" \n");
    if (end == std::string::npos) return "it gave no reason";
    const std::size_t begin = text.rfind('\n', end);
    return text.substr(begin == std::string::npos ? 0 : begin + 1, end - begin);
}

void run_gnuplot(const std::string& script, const std::filesystem::path& output) {
    const auto gnuplot = find_program("gnuplot");
    if (!gnuplot) {
        throw Error(
            "gnuplot is not installed, which draws the pictures; install it, on Debian by 'apt install "
            "gnuplot-nox'");
    }
    const TemporaryFolder folder;
    std::ofstream stream(folder / "plot.gnuplot");
    stream << script;
    stream.close();
    if (!stream) throw Error(fmt::format("{}: cannot be written", (folder / "plot.gnuplot").string()));
    const int status = run_subprocess(
        {gnuplot->string(), "-c", (folder / "plot.gnuplot").string(), output.string()}, folder / "messages");
    if (status != 0 || !std::filesystem::exists(output)) {
        throw Error(fmt::format("gnuplot failed: {}", last_line(read_bytes(folder / "messages"))));
    }
}

}  // namespace

MotionPlot plot_motion(const std::filesystem::path& file, const Motion& motion, const BodyMotion& body,
                       int run, int copy) {
    const Measures measures = measure(motion, body, run, copy);
    const Strip strip = choose_strip(motion, body, run, copy);
    const StripPanel left = strip_panel(motion, body, run, copy, strip);
    const SeriesPanel right = series_panel(motion, body, run, copy, strip, measures, left.right);
    const std::string script = preamble(file.extension() == ".svg") + left.data + right.data +
                               "set multiplot\n" + title_of(motion, body, run, copy, measures) + left.plots +
                               right.plots + "unset multiplot\nset output\n";
    replace_file(file, [&](const std::filesystem::path& temporary) { run_gnuplot(script, temporary); });
    const auto time = [&](int frame) { return motion.times[static_cast<std::size_t>(frame)]; };
    return {static_cast<int>(strip.frames.size()), {time(strip.first), time(strip.last)}, measures};
}

}  // namespace samara
