#include "support/text_extent.hpp"

#include <array>
#include <stdexcept>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

namespace samara::test {
namespace {

/// Of fonts-dejavu-core.
constexpr std::array font_files = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                   "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"};

/// A font, open as long as it is used.
class Font {
  public:
    explicit Font(const char* file) {
        if (FT_Init_FreeType(&library_) != 0 || FT_New_Face(library_, file, 0, &face_) != 0) {
            throw std::runtime_error(std::string(file) + " cannot be read: install fonts-dejavu-core");
        }
    }
    ~Font() {
        FT_Done_Face(face_);
        FT_Done_FreeType(library_);
    }
    Font(const Font&) = delete;
    Font& operator=(const Font&) = delete;

    /// Adds a letter to the text so far, all in shares of the font's size.
    void add(unsigned long letter, TextExtent& text) const {
        if (FT_Load_Char(face_, letter, FT_LOAD_NO_SCALE) != 0) throw std::runtime_error("no such letter");
        const double unit = 1.0 / face_->units_per_EM;
        FT_BBox box;
        FT_Outline_Get_CBox(&face_->glyph->outline, &box);
        if (box.xMax > box.xMin) {
            const auto at = [&](FT_Pos x, FT_Pos y) {
                return Eigen::Vector2d(text.width + unit * static_cast<double>(x),
                                       -unit * static_cast<double>(y));
            };
            text.ink.extend(at(box.xMin, box.yMin)).extend(at(box.xMax, box.yMax));
        }
        text.width += unit * static_cast<double>(face_->glyph->advance.x);
    }

  private:
    FT_Library library_ = nullptr;
    FT_Face face_ = nullptr;
};

/// The code point that begins at `place`, which moves to the next.
unsigned long next_letter(const std::string& text, std::size_t& place) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text.at(i)); };
    const unsigned long first = byte(place++);
    const int more = first < 0xc0 ? 0 : first < 0xe0 ? 1 : first < 0xf0 ? 2 : 3;
    unsigned long letter = more == 0 ? first : first & (0x3fU >> static_cast<unsigned>(more));
    for (int i = 0; i < more; ++i) letter = letter << 6U | (byte(place++) & 0x3fU);
    return letter;
}

}  // namespace

TextExtent text_extent(const std::string& text, double size, bool bold) {
    static const Font plain_font(font_files[0]);
    static const Font bold_font(font_files[1]);
    TextExtent extent;
    for (std::size_t place = 0; place < text.size();) {
        (bold ? bold_font : plain_font).add(next_letter(text, place), extent);
    }
    extent.width *= size;
    if (!extent.ink.isEmpty()) extent.ink = PixelBox(size * extent.ink.min(), size * extent.ink.max());
    return extent;
}

}  // namespace samara::test
