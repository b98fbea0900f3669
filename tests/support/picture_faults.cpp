#include "support/picture_faults.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

namespace samara::test {
namespace {

using Eigen::Vector2d;

constexpr double on_edge = 0.3;    // pixels
constexpr double unseen = 1.0;     // pixels: texts may touch by less, curves are longer
constexpr double at_a_mark = 1.5;  // pixels

std::string place_of(const PixelBox& panel) {
    return fmt::format("the panel at ({:.0f}, {:.0f})", panel.min().x(), panel.min().y());
}

bool overlap(const PixelBox& a, const PixelBox& b) {
    const PixelBox both = a.intersection(b);
    return !both.isEmpty() && both.sizes().minCoeff() > unseen;
}

/// The box with its sides moved outwards.
PixelBox grown(const PixelBox& box, double by) {
    return PixelBox(box.min().array() - by, box.max().array() + by);
}

bool is_number(const std::string& words) {
    std::string text = words;
    // Figures with the typographic minus, and powers of ten.
    for (std::size_t minus = text.find("−"); minus != std::string::npos; minus = text.find("−")) {
        text.replace(minus, std::string_view("−").size(), 1, '-');
    }
    std::erase(text, '%');
    std::erase(text, ' ');
    char* end = nullptr;
    std::strtod(text.c_str(), &end);
    return !text.empty() && (*end == '\0' || *end == '-');
}

bool is_broken_number(const std::string& words) {
    std::string text = words;
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    for (const char* word : {"nan", "inf"}) {
        for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
            const auto is_letter = [&](std::size_t place) {
                return place < text.size() && std::isalpha(static_cast<unsigned char>(text[place])) != 0;
            };
            if ((at == 0 || !is_letter(at - 1)) && !is_letter(at + 3)) return true;
        }
    }
    return false;
}

/// The numbers along the left and the lower side of a panel, by their distance along the side.
struct AxisNumbers {
    std::vector<double> left;  ///< heights in the picture
    std::vector<double> below;

    [[nodiscard]] bool at_height(double height) const {
        return std::any_of(left.begin(), left.end(), [&](double y) { return std::abs(y - height) < 4.0; });
    }
};

AxisNumbers numbers_of(const SvgPicture& picture, const PixelBox& panel) {
    AxisNumbers numbers;
    for (const SvgText& text : picture.texts) {
        if (!is_number(text.words)) continue;
        const Vector2d middle = text.box.center();
        const double beside = panel.min().x() - text.box.max().x();
        const double under = text.box.min().y() - panel.max().y();
        if (beside > 0.0 && beside < 1.5 * text.size && middle.y() > panel.min().y() - 0.6 * text.size &&
            middle.y() < panel.max().y() + 0.6 * text.size) {
            numbers.left.push_back(middle.y());
        } else if (under > 0.0 && under < 2.0 * text.size && middle.x() > panel.min().x() - 1.0 &&
                   middle.x() < panel.max().x() + 1.0) {
            numbers.below.push_back(middle.x());
        }
    }
    return numbers;
}

/// Finds the faults of one picture.
class Judge {
  public:
    explicit Judge(const SvgPicture& picture) : picture_(picture) {}

    std::vector<std::string> faults() {
        for (const std::string& word : picture_.unreadable) add("'{}' is no finite number", word);
        judge_texts();
        for (std::size_t panel = 0; panel < picture_.panels.size(); ++panel) judge_panel(panel);
        for (const SvgCurve& curve : picture_.curves) {
            if (!curve.panel) judge_extent(curve, picture_.canvas);
        }
        return std::move(faults_);
    }

  private:
    template <typename... Arguments>
    void add(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
        faults_.push_back(fmt::format(text, std::forward<Arguments>(arguments)...));
    }

    void judge_texts() {
        for (std::size_t i = 0; i < picture_.texts.size(); ++i) {
            const SvgText& text = picture_.texts[i];
            if (is_broken_number(text.words)) add("the text '{}' holds no number", text.words);
            if (!picture_.canvas.contains(text.box)) add("the text '{}' leaves the picture", text.words);
            for (std::size_t j = 0; j < i; ++j) {
                if (overlap(text.box, picture_.texts[j].box)) {
                    add("the texts '{}' and '{}' overlap", picture_.texts[j].words, text.words);
                }
            }
            for (const PixelBox& panel : picture_.panels) {
                if (overlap(text.box, panel) && !grown(panel, unseen).contains(text.box)) {
                    add("the text '{}' lies across the frame of {}", text.words, place_of(panel));
                }
            }
            for (const SvgCurve& curve : picture_.curves) {
                for (const Vector2d& mark : curve.marks) {
                    if (!text.box.contains(mark)) continue;
                    add("a point of '{}' lies on the text '{}'", curve.title, text.words);
                    break;
                }
            }
        }
    }

    void judge_panel(std::size_t index) {
        const PixelBox& panel = picture_.panels[index];
        const AxisNumbers numbers = numbers_of(picture_, panel);
        if (numbers.left.size() == 1) add("{} has one number beside it", place_of(panel));
        if (numbers.below.size() == 1) add("{} has one number below it", place_of(panel));
        bool shows = false;
        for (const SvgCurve& curve : picture_.curves) {
            if (curve.panel != index) continue;
            shows = shows || can_be_seen(curve);
            judge_extent(curve, panel);
            judge_ends(curve, panel, numbers);
        }
        if (!shows) add("{} shows no curve", place_of(panel));
    }

    static bool can_be_seen(const SvgCurve& curve) {
        const auto long_enough = [](const Pixels& line) {
            PixelBox box;
            for (const Vector2d& place : line) box.extend(place);
            return !line.empty() && box.sizes().maxCoeff() > unseen;
        };
        return !curve.marks.empty() || std::any_of(curve.lines.begin(), curve.lines.end(), long_enough) ||
               std::any_of(curve.areas.begin(), curve.areas.end(), long_enough);
    }

    void judge_extent(const SvgCurve& curve, const PixelBox& frame) {
        PixelBox box;
        for (const auto& parts : {curve.lines, curve.areas, {curve.marks}}) {
            for (const Pixels& part : parts) {
                for (const Vector2d& place : part) box.extend(place);
            }
        }
        if (!box.isEmpty() && !grown(frame, unseen).contains(box)) {
            add("'{}' leaves {}", curve.title, place_of(frame));
        }
    }

    void judge_ends(const SvgCurve& curve, const PixelBox& panel, const AxisNumbers& numbers) {
        bool cut = false;
        for (std::size_t i = 0; i < curve.lines.size(); ++i) {
            cut = cut || is_cut(curve, curve.lines[i].front(), i == 0, panel, numbers) ||
                  is_cut(curve, curve.lines[i].back(), i + 1 == curve.lines.size(), panel, numbers);
        }
        for (const Pixels& area : curve.areas) {
            for (std::size_t i = 0; i < area.size(); ++i) {
                cut = cut || lies_along_edge(area[i], area[(i + 1) % area.size()], panel);
            }
        }
        if (cut) add("'{}' is cut off at the frame of {}", curve.title, place_of(panel));
    }

    /// Whether the end of a line is none of the curve. `outermost`: the curve's first or last place.
    static bool is_cut(const SvgCurve& curve, const Vector2d& end, bool outermost, const PixelBox& panel,
                       const AxisNumbers& numbers) {
        const Vector2d from_low = end - panel.min();
        const Vector2d from_high = panel.max() - end;
        const bool beside = std::min(from_low.x(), from_high.x()) < on_edge;
        const bool above = std::min(from_low.y(), from_high.y()) < on_edge;
        if (!beside && !above) return false;
        if (!curve.marks.empty()) {
            return std::none_of(curve.marks.begin(), curve.marks.end(),
                                [&](const Vector2d& mark) { return (mark - end).norm() < at_a_mark; });
        }
        return !outermost || (above && !beside && !numbers.at_height(end.y()));
    }

    static bool lies_along_edge(const Vector2d& a, const Vector2d& b, const PixelBox& panel) {
        for (const int axis : {0, 1}) {
            for (const double edge : {panel.min()[axis], panel.max()[axis]}) {
                if (std::abs(a[axis] - edge) < on_edge && std::abs(b[axis] - edge) < on_edge &&
                    (a - b).norm() > unseen) {
                    return true;
                }
            }
        }
        return false;
    }

    const SvgPicture& picture_;
    std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> faults_of(const SvgPicture& picture) {
    return Judge(picture).faults();
}

}  // namespace samara::test
