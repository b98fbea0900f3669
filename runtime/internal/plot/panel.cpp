#include "samara/internal/plot/panel.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace samara {

std::string begin_panel(const Box& box, const PanelAxis& across, const PanelAxis& up,
                        const std::string& right) {
    const auto step = [](const PanelAxis& axis, double pixels, double least) {
        return axis.step > 0.0 ? axis.step : tic_step(axis.range, pixels, least);
    };
    std::string text = place_frame(box);
    text += axis("x", across.range, step(across, box.right - box.left, across_least));
    text += axis("y", up.range, step(up, box.top - box.bottom, up_least));
    text += across.title.empty() ? "set format x ''\n" : "set format x '%g'\n";
    if (!across.title.empty()) text += x_title(across.title, box);
    text += "set format y '%g'\n";
    text += bold_label(up.title, box.left, box.top + canvas::header_lift, "left", black);
    if (!right.empty()) text += label(right, box.right, box.top + canvas::header_lift, "right", gray);
    return text;
}

std::string shaded_window(const TimeWindow& window) {
    if (window.end <= window.begin) return "";
    return fmt::format(
        "set object 1 rectangle from first {:.9g}, graph 0 to first {:.9g}, graph 1 behind fs solid 1 "
        "noborder "
        "fc rgb '#f0f3f7'\n",
        window.begin, window.end);
}

std::string end_panel() {
    return "unset label; unset arrow; unset object\n";
}

Range airy_range(const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const double size = *high - *low > 1e-12 ? *high - *low : 1.0;
    return {*low - 0.08 * size, *high + 0.08 * size};
}

}  // namespace samara
