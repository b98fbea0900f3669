#include "samara/internal/plot/comparison_panels.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "samara/core/base/angles.hpp"

namespace samara {
namespace {

constexpr double most_swings = 24.0;
constexpr std::size_t most_points = 8000;
constexpr double least_power = 1e-6;  // 1/Hz: less is no swing that can be seen

std::string header(const std::string& title, const std::string& right, const Box& box) {
    return bold_label(title, box.left, box.top + canvas::header_lift, "left", black) +
           label(right, box.right, box.top + canvas::header_lift, "right", gray);
}

std::string line(const std::string& block, unsigned color, double width) {
    return fmt::format("{} using 1:2 with lines lc rgb '#{:06x}' lw {} notitle", block, color, width);
}

void add_inclination(std::string& data, const std::string& block, const FallSeries& fall, double end) {
    fmt::memory_buffer rows;
    auto out = std::back_inserter(rows);
    fmt::format_to(out, "{} << EOD\n", block);
    const std::size_t stride = 1 + fall.times.size() / most_points;
    for (std::size_t i = 0; i < fall.times.size() && fall.times[i] <= end; i += stride) {
        fmt::format_to(out, "{:.6g} {:.5g}\n", fall.times[i], degrees * fall.inclinations[i]);
    }
    fmt::format_to(out, "EOD\n");
    data += fmt::to_string(rows);
}

InclinationHistogram share_of_time(const FallSet& set) {
    InclinationHistogram shares{};
    double all = 0.0;
    for (const auto& fall : set.histograms) {
        for (const InclinationHistogram& piece : fall) {
            for (std::size_t i = 0; i < piece.size(); ++i) {
                shares[i] += piece[i];
                all += piece[i];
            }
        }
    }
    for (double& share : shares) share /= all;
    return shares;
}

std::string distribution_data(const std::string& block, const InclinationHistogram& shares) {
    std::string data = block + " << EOD\n0 0\n";
    double below = 0.0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        below += 100.0 * shares[i];
        data += fmt::format("{:.5g} {:.5g}\n", 90.0 * static_cast<double>(i + 1) / inclination_bins, below);
    }
    return data + "EOD\n";
}

/// Where the distribution functions are farthest apart.
struct Gap {
    double angle = 0.0;   // degrees
    double motion = 0.0;  // per cent
    double reference = 0.0;
};

Gap widest_gap(const InclinationHistogram& motion, const InclinationHistogram& reference) {
    Gap widest;
    Gap here;
    for (std::size_t i = 0; i < motion.size(); ++i) {
        here.angle = 90.0 * static_cast<double>(i + 1) / inclination_bins;
        here.motion += 100.0 * motion[i];
        here.reference += 100.0 * reference[i];
        if (std::abs(here.motion - here.reference) > std::abs(widest.motion - widest.reference))
            widest = here;
    }
    return widest;
}

std::string spectrum_data(const std::string& block, const Spectrum& spectrum, double end) {
    std::string data = block + " << EOD\n";
    for (std::size_t i = 0; i < spectrum.power.size() && spectrum.frequency(i) <= end; ++i) {
        data += fmt::format("{:.6g} {:.5g}\n", spectrum.frequency(i), spectrum.power[i]);
    }
    return data + "EOD\n";
}

double highest_power(const Spectrum& spectrum) {
    if (spectrum.power.empty()) return 0.0;
    return *std::max_element(spectrum.power.begin(), spectrum.power.end());
}

std::string vertical_line(double x, unsigned color, const char* dashes) {
    return fmt::format(
        "set arrow from first {0:.9g}, graph 0 to first {0:.9g}, graph 1 nohead back lc rgb '#{1:06x}' lw 2 "
        "dt {2}\n",
        x, color, dashes);
}

/// Three times the frequency, or what the frames resolve where nothing swings.
double drawn_frequency(const Comparison& all) {
    double highest = 0.0;
    for (const FallSet* set : {&all.motion, &all.reference}) {
        if (const auto& frequency = set->figures[Figure::frequency]) {
            highest = std::max(highest, 3.0 * frequency->value);
        }
    }
    if (highest > 0.0) return highest;
    const Spectrum& spectrum = all.reference.spectrum;
    return spectrum.step * static_cast<double>(std::max<std::size_t>(spectrum.power.size(), 2) - 1);
}

}  // namespace

double drawn_time(const Comparison& comparison) {
    const double common = std::min(comparison.motion_lengths.shortest, comparison.reference_lengths.shortest);
    const auto& frequency = comparison.reference.figures[Figure::frequency];
    if (!frequency) return common;
    return std::min(common, most_swings * 0.5 / frequency->value);
}

PanelText inclination_panel(const Comparison& comparison, const Box& box) {
    PanelText text;
    const double end = drawn_time(comparison);
    std::string plot;
    double steepest = 0.0;
    int blocks = 0;
    const auto add = [&](const FallSeries& fall, unsigned color, double width) {
        const std::string block = fmt::format("$inclination{}", blocks);
        add_inclination(text.data, block, fall, end);
        plot += (blocks++ == 0 ? "plot " : ", ") + line(block, color, width);
        steepest = std::max(steepest,
                            degrees * *std::max_element(fall.inclinations.begin(), fall.inclinations.end()));
    };
    for (const FallSeries& fall : comparison.motion.more) add(fall, faint_motion_color, 1.0);
    for (const FallSeries& fall : comparison.reference.more) add(fall, faint_reference_color, 1.0);
    add(comparison.motion.example, motion_color, 3.0);
    add(comparison.reference.example, reference_color, 3.0);

    const Range angles = {0.0, steepest > 60.0 ? 90.0 : std::max(10.0, 10.0 * std::ceil(0.105 * steepest))};
    text.plots = place_frame(box) + axis("x", {0.0, end}, tic_step({0.0, end}, box.right - box.left, 90.0));
    text.plots += axis("y", angles, angles.high > 60.0 ? 30.0 : 10.0);
    text.plots += "set format x '%g'\nset format y '%g'\n" + x_title("time since the release (s)", box);
    text.plots += header("Inclination (°)", "shaded: the window of all figures", box);
    if (comparison.window.begin < end) {
        text.plots += fmt::format(
            "set object 1 rectangle from first {:.9g}, graph 0 to first {:.9g}, graph 1 behind fs solid 1 "
            "noborder fc rgb '#f0f3f7'\n",
            comparison.window.begin, std::min(end, comparison.window.end));
    }
    if (const auto& swing = comparison.first_swing.end; swing && *swing < end) {
        text.plots += vertical_line(*swing, gray, "(2,4)");
        text.plots += fmt::format(
            "set style textbox opaque noborder margins 0.3,0.3\n"
            "set label 98 'first swing' at first {:.9g}, graph 0.94 {} tc rgb '#{:06x}' front boxed\n",
            *swing, *swing < 0.5 * end ? "left offset character 0.6,0" : "right offset character -0.6,0",
            gray);
    }
    text.plots += plot + '\n' + end_panel();
    return text;
}

PanelText spectrum_panel(const Comparison& comparison, const Box& box) {
    PanelText text;
    const double end = drawn_frequency(comparison);
    const double highest =
        std::max(highest_power(comparison.motion.spectrum), highest_power(comparison.reference.spectrum));
    const bool swings = highest > least_power;
    const double top = swings ? 1.1 * highest : 1.0;
    text.data = spectrum_data("$motion_spectrum", comparison.motion.spectrum, end) +
                spectrum_data("$reference_spectrum", comparison.reference.spectrum, end);
    text.plots = place_frame(box) + axis("x", {0.0, end}, tic_step({0.0, end}, box.right - box.left, 80.0));
    text.plots += axis("y", {0.0, top}, tic_step({0.0, top}, box.top - box.bottom, 60.0));
    text.plots += x_title("frequency (Hz), half that of the inclination", box);
    text.plots += header("Spectrum (1/Hz)", swings ? "dashed: by the minima" : "no swings", box);
    for (const auto& [set, color] :
         {std::pair(&comparison.motion, motion_color), std::pair(&comparison.reference, reference_color)}) {
        if (const auto& frequency = set->figures[Figure::frequency]) {
            text.plots += vertical_line(frequency->value, color, "(8,6)");
        }
    }
    text.plots += "plot " + line("$motion_spectrum", motion_color, 3.0) + ", " +
                  line("$reference_spectrum", reference_color, 3.0) + '\n' + end_panel();
    return text;
}

PanelText distribution_panel(const Comparison& comparison, const Box& box) {
    PanelText text;
    const InclinationHistogram motion = share_of_time(comparison.motion);
    const InclinationHistogram reference = share_of_time(comparison.reference);
    text.data = distribution_data("$motion_distribution", motion) +
                distribution_data("$reference_distribution", reference);
    const Gap gap = widest_gap(motion, reference);
    text.plots = place_frame(box) + axis("x", {0.0, 90.0}, 30.0) + axis("y", {0.0, 100.0}, 25.0);
    text.plots += x_title("inclination (°)", box);
    std::string right = fmt::format("{:.0f} % apart", 100.0 * comparison.distribution.distance);
    if (comparison.distribution.chance) {
        right += fmt::format(", p {:.1g}", comparison.distribution.chance->probability);
    }
    text.plots += header("Time below (%)", right, box);
    if (gap.angle > 0.0) {
        text.plots += fmt::format(
            "set arrow from {0:.9g},{1:.9g} to {0:.9g},{2:.9g} heads size screen 0.006,25 front lc rgb "
            "'#333333' lw 2\n",
            gap.angle, gap.motion, gap.reference);
    }
    text.plots += "plot " + line("$motion_distribution", motion_color, 3.0) + ", " +
                  line("$reference_distribution", reference_color, 3.0) + '\n' + end_panel();
    return text;
}

}  // namespace samara
