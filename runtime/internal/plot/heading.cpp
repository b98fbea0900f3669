#include "samara/internal/plot/heading.hpp"

#include <algorithm>

#include "samara/internal/plot/canvas.hpp"

namespace samara {
namespace {

constexpr double left_edge = 45.0;
constexpr double right_edge = canvas::width - 45.0;
constexpr double upper = canvas::height - 55.0;
constexpr double lower = canvas::height - 108.0;
constexpr double gap = 40.0;              // between what stands left and right in a line
constexpr double narrowest_name = 250.0;  // a title's, before its type becomes smaller
constexpr double narrowest_side = 300.0;  // a name at the right
constexpr double widest_side = 620.0;

// From the blank to the tilde, in hundredths of the size.
constexpr std::array<unsigned char, 95> ascii_widths = {
    35, 46, 52, 84, 70, 100, 87, 31,  46,  46, 52, 84, 38, 42, 38, 37, 70, 70, 70, 70, 70, 70,  70, 70,
    70, 70, 40, 40, 84, 84,  84, 58,  100, 77, 76, 73, 83, 68, 68, 82, 84, 37, 37, 77, 64, 100, 84, 85,
    73, 85, 77, 72, 68, 81,  77, 110, 77,  72, 73, 46, 37, 46, 84, 50, 50, 67, 72, 59, 72, 68,  44, 72,
    71, 34, 34, 67, 34, 104, 71, 69,  72,  72, 49, 60, 48, 71, 65, 92, 65, 65, 58, 71, 37, 71,  84};
constexpr double other_width = 1.0;
constexpr const char* ellipsis = "…";

bool begins_letter(char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0U) != 0x80U;
}

/// A line's right side, its name cut to the width there is.
std::string side_label(const HeadingSide& side, double width, double y, double& used) {
    if (side.name.empty() && side.rest.empty()) return "";
    const double rest = text_width(side.rest, canvas::heading_size);
    const std::string text =
        shortened(side.name, canvas::heading_size, std::min(width, widest_side) - rest, Keep::end) +
        side.rest;
    used = text_width(text, canvas::heading_size) + gap;
    return bold_label(text, right_edge, y, "right", side.color);
}

}  // namespace

double text_width(const std::string& text, double size) {
    double width = 0.0;
    for (const char byte : text) {
        if (!begins_letter(byte)) continue;
        const auto place = static_cast<std::size_t>(static_cast<unsigned char>(byte)) - ' ';
        width += place < ascii_widths.size() ? 0.01 * ascii_widths[place] : other_width;
    }
    return size * width;
}

std::string shortened(const std::string& text, double size, double width, Keep keep) {
    if (text_width(text, size) <= width) return text;
    std::string kept = text;
    while (!kept.empty() && text_width(ellipsis + kept, size) > width) {
        // A letter may have several bytes.
        bool whole = false;
        while (!kept.empty() && !whole) {
            if (keep == Keep::beginning) {
                whole = begins_letter(kept.back());
                kept.pop_back();
            } else {
                kept.erase(0, 1);
                whole = kept.empty() || begins_letter(kept.front());
            }
        }
    }
    return keep == Keep::beginning ? kept + ellipsis : ellipsis + kept;
}

std::string heading(const Heading& heading) {
    const double room = right_edge - left_edge;
    double used = 0.0;
    std::string text = side_label(heading.right[0], room, upper, used);
    const double title_room = room - used;
    const double rest = text_width(heading.rest, canvas::title_size);
    const std::string title =
        shortened(heading.name, canvas::title_size, std::max(title_room - rest, narrowest_name)) +
        heading.rest;
    const double share = std::min(1.0, title_room / text_width(title, canvas::title_size));
    text += bold_label(title, left_edge, upper, "left", black, share);
    text += label(heading.below, left_edge, lower, "left", gray);
    const double below = text_width(heading.below, canvas::heading_size) + gap;
    return text + side_label(heading.right[1], std::max(room - below, narrowest_side), lower, used);
}

}  // namespace samara
