#include "internal/plot/body_picture.hpp"

#include "internal/plot/heading.hpp"

namespace samara {
namespace {

constexpr double left_edge = 125.0;
constexpr double right_edge = canvas::width - 45.0;
constexpr double across_gap = 150.0;
constexpr double up_gap = 190.0;
constexpr double key_height = canvas::height - 108.0;
constexpr double key_gap = 35.0;

}  // namespace

Box quarter(int column, int row) {
    const double wide = 0.5 * (right_edge - left_edge - across_gap);
    const double tall = 0.5 * (canvas::top - canvas::bottom - up_gap);
    const double left = left_edge + column * (wide + across_gap);
    const double bottom = canvas::bottom + (1 - row) * (tall + up_gap);
    return {left, left + wide, bottom, bottom + tall};
}

ColorKey::ColorKey() : ColorKey(right_edge, key_height) {}

std::string ColorKey::add(const std::string& word, unsigned color) {
    const std::string text = bold_label(word, right_, height_, "right", color);
    right_ -= text_width(word, canvas::heading_size) + key_gap;
    return text;
}

}  // namespace samara
