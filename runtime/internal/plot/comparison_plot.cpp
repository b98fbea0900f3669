#include "samara/internal/plot/comparison_plot.hpp"

#include <cmath>

#include <fmt/format.h>

#include "samara/internal/plot/comparison_panels.hpp"
#include "samara/internal/plot/gnuplot.hpp"
#include "samara/internal/plot/heading.hpp"

namespace samara {
namespace {

constexpr double left_edge = 125.0;
constexpr double path_right = 690.0;
constexpr double series_left = 800.0;
constexpr double right_edge = canvas::width - 45.0;
constexpr double lower_top = 500.0;
constexpr double upper_bottom = 715.0;
constexpr double middle_gap = 110.0;

std::string per_cent(const char* what, const FigureComparison& figure) {
    if (!figure.relative) return "";
    std::string text = fmt::format("{} {}{:.0f}", what, *figure.relative < 0.0 ? "−" : "+",
                                   100.0 * std::abs(*figure.relative));
    if (figure.difference_error) {
        text +=
            fmt::format(" ± {:.0f}", 100.0 * *figure.difference_error / std::abs(figure.reference->value));
    }
    return text + " %";
}

HeadingSide side_of(const std::string& name, const FallSet& set, unsigned color) {
    return {name, set.distinct == 1 ? "" : fmt::format(" ({} falls)", set.distinct), color};
}

std::string title_of(const Comparison& all, const std::string& motion, const std::string& reference) {
    std::string title = ": ";
    title += all.regimes_agree || !all.judges_inclination
                 ? std::string(name_of(all.motion.regimes.commonest()))
                 : fmt::format("{} against {}", name_of(all.motion.regimes.commonest()),
                               name_of(all.reference.regimes.commonest()));
    title += all.agrees ? ", agrees with the reference" : ", differs from the reference";
    if (!all.certain) title += " (not certain)";
    std::string below;
    for (const Figure figure : compared_figures) {
        const std::string part = per_cent(catalogued(figure).heading, all.figures[figure]);
        if (!part.empty()) below += part + "  ·  ";
    }
    below += fmt::format("{:.2f} s to {:.2f} s of fall", all.window.begin, all.window.end);
    return heading(
        {all.motion_body,
         title,
         below,
         {side_of(motion, all.motion, motion_color), side_of(reference, all.reference, reference_color)}});
}

}  // namespace

void plot_comparison(const std::filesystem::path& file, const Comparison& comparison,
                     const std::string& motion, const std::string& reference) {
    const double half = 0.5 * (right_edge - series_left - middle_gap);
    const PanelText panels[] = {
        path_panel(comparison, left_edge, path_right),
        inclination_panel(comparison, {series_left, right_edge, upper_bottom, canvas::top}),
        spectrum_panel(comparison, {series_left, series_left + half, canvas::bottom, lower_top}),
        distribution_panel(comparison, {right_edge - half, right_edge, canvas::bottom, lower_top}),
    };
    std::string data;
    std::string plots;
    for (const PanelText& panel : panels) {
        data += panel.data;
        plots += panel.plots;
    }
    draw_picture(file, data + "set multiplot\n" + title_of(comparison, motion, reference) + plots +
                           "unset multiplot\nset output\n");
}

}  // namespace samara
