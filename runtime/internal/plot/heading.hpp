#pragma once

#include <array>
#include <string>

namespace samara {

/// What stands at the right end of one of a picture's two head lines.
struct HeadingSide {
    std::string name;
    std::string rest;  ///< is never left out, unlike the name's beginning
    unsigned color = 0;
};

/// The head of a picture: in large type `name` and what is said of it, below that a gray line, and at the
/// right ends of the two lines what else there is.
struct Heading {
    std::string name;
    std::string rest;
    std::string below;
    std::array<HeadingSide, 2> right = {};
};

/// gnuplot commands for the head of a picture. A name too long for its line is cut with an ellipsis; where
/// that is not enough, the large type becomes smaller: nothing leaves the picture or overlaps.
std::string heading(const Heading& heading);

/// How wide a UTF-8 text is in bold DejaVu Sans of a size, in the size's unit: exact for ASCII, else no less
/// than that of most letters. Plain type is narrower.
double text_width(const std::string& text, double size);

/// Which part of a text is kept.
enum class Keep { beginning, end };

/// The text, or as much of it as is no wider than `width` with an ellipsis in place of the rest.
std::string shortened(const std::string& text, double size, double width, Keep keep = Keep::beginning);

}  // namespace samara
