#include "samara/internal/plot/body_picture.hpp"

#include <fmt/format.h>

#include "samara/internal/plot/heading.hpp"

namespace samara {
namespace {

constexpr double left_edge = 125.0;
constexpr double right_edge = canvas::width - 45.0;
constexpr double across_gap = 150.0;
constexpr double up_gap = 110.0;
constexpr double up_gap_with_axis = 190.0;
constexpr double key_height = canvas::height - 108.0;
constexpr double key_gap = 35.0;

}  // namespace

Box quarter(int column, int row, bool own_axes) {
    const double gap = own_axes ? up_gap_with_axis : up_gap;
    const double wide = 0.5 * (right_edge - left_edge - across_gap);
    const double tall = 0.5 * (canvas::top - canvas::bottom - gap);
    const double left = left_edge + column * (wide + across_gap);
    const double bottom = canvas::bottom + (1 - row) * (tall + gap);
    return {left, left + wide, bottom, bottom + tall};
}

std::string error_bars(const std::string& block, unsigned color) {
    return fmt::format(
        "{} using 1:($2-$3):(0):(2*$3) with vectors heads size screen 0.003,90 lw 1.5 lc rgb '#{:06x}' "
        "notitle",
        block, color);
}

ColorKey::ColorKey() : ColorKey(right_edge, key_height) {}

std::string ColorKey::add(const std::string& word, unsigned color) {
    const std::string text = bold_label(word, right_, height_, "right", color);
    right_ -= text_width(word, canvas::heading_size) + key_gap;
    return text;
}

}  // namespace samara
