#include "support/svg_picture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string_view>

#include <pugixml.hpp>

namespace samara::test {
namespace {

using Eigen::Vector2d;

constexpr double same = 0.05;           // pixels: gnuplot rounds to 0.01
constexpr double least_panel = 40.0;    // pixels
constexpr double key_sample_gap = 6.0;  // font sizes between a key's text and the end of its sample

/// The words of a text between blanks.
std::vector<std::string> words_of(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n";
    std::vector<std::string> words;
    for (std::size_t begin = text.find_first_not_of(blanks); begin != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
        words.emplace_back(text.substr(begin, end - begin));
        begin = text.find_first_not_of(blanks, end);
    }
    return words;
}

/// Takes the numbers of an attribute apart, and notes those that are none.
class Numbers {
  public:
    explicit Numbers(std::vector<std::string>& unreadable) : unreadable_(&unreadable) {}

    double number(const std::string& word) {
        char* end = nullptr;
        const double value = std::strtod(word.c_str(), &end);
        if (end != word.c_str() && *end == '\0' && std::isfinite(value)) return value;
        unreadable_->push_back(word);
        return 0.0;
    }

    /// "x,y".
    Vector2d place(const std::string& word) {
        const std::size_t comma = std::min(word.find(','), word.size());
        const double x = number(word.substr(0, comma));
        return {x, number(word.substr(std::min(comma + 1, word.size())))};
    }

    /// "x,y x,y ...".
    Pixels places(std::string_view text) {
        Pixels result;
        for (const std::string& word : words_of(text)) result.push_back(place(word));
        return result;
    }

    /// "Mx,y Lx,y ... Z", places of the picture: gnuplot writes nothing else.
    std::vector<Pixels> lines(std::string_view text) {
        std::vector<Pixels> result;
        for (const std::string& word : words_of(text)) {
            if (word == "Z" && !result.empty()) {
                result.back().push_back(result.back().front());
            } else {
                if (word.front() == 'M' || result.empty()) result.emplace_back();
                result.back().push_back(
                    place(word.front() == 'M' || word.front() == 'L' ? word.substr(1) : word));
            }
        }
        return result;
    }

  private:
    std::vector<std::string>* unreadable_;
};

/// What is in brackets after `name` in a transform; empty where it is not there.
std::string transform_part(const std::string& transform, const std::string& name) {
    const std::size_t begin = transform.find(name + '(');
    if (begin == std::string::npos) return "";
    const std::size_t open = begin + name.size() + 1;
    return transform.substr(open, transform.find(')', open) - open);
}

bool is_curve(const pugi::xml_node& node) {
    return std::string_view(node.attribute("id").value()).starts_with("gnuplot_plot_");
}

class Reader {
  public:
    SvgPicture picture;

    void read(const pugi::xml_node& node, SvgCurve* curve) {
        for (const pugi::xml_node child : node.children()) {
            const std::string_view name = child.name();
            if (name == "g" && is_curve(child)) {
                SvgCurve one;
                one.title = child.child("title").text().get();
                const std::size_t texts = picture.texts.size();
                read(child, &one);
                drop_key_sample(one, texts);
                join(one.lines);
                waiting_.push_back(picture.curves.size());
                picture.curves.push_back(std::move(one));
            } else if (name == "g" && child.child("text")) {
                add_text(child);
            } else if (name == "g") {
                read(child, curve);
            } else if (name == "path") {
                const std::vector<Pixels> lines = numbers_.lines(child.attribute("d").value());
                if (curve) {
                    curve->lines.insert(curve->lines.end(), lines.begin(), lines.end());
                } else {
                    add_frame(lines);
                }
            } else if (name == "polygon" && curve) {
                curve->areas.push_back(numbers_.places(child.attribute("points").value()));
            } else if (name == "use" && curve) {
                curve->marks.push_back(
                    numbers_.place(transform_part(child.attribute("transform").value(), "translate")));
            }
        }
    }

  private:
    /// A rectangle's corners and no other places make a frame; the curves before it are on it.
    void add_frame(const std::vector<Pixels>& lines) {
        PixelBox box;
        std::size_t count = 0;
        for (const Pixels& line : lines) {
            for (const Vector2d& place : line) {
                box.extend(place);
                ++count;
            }
        }
        if (count < 4 || box.sizes().minCoeff() < least_panel) return;
        for (const Pixels& line : lines) {
            for (const Vector2d& place : line) {
                const Vector2d inside = (place - box.min()).cwiseMin(box.max() - place);
                if (inside.maxCoeff() > same) return;
            }
        }
        std::size_t panel = 0;
        while (panel < picture.panels.size() && !picture.panels[panel].isApprox(box, 1e-5)) ++panel;
        if (panel == picture.panels.size()) picture.panels.push_back(box);
        for (const std::size_t curve : waiting_) picture.curves[curve].panel = panel;
        waiting_.clear();
    }

    void add_text(const pugi::xml_node& group) {
        const pugi::xml_node line = group.child("text");
        const double group_size = numbers_.number(group.attribute("font-size").value());
        SvgText text;
        text.size = group_size;
        Vector2d pen = Vector2d::Zero();
        const auto add = [&](std::string words, const pugi::xml_node& part) {
            if (text.words.empty()) words.erase(0, words.find_first_not_of(' '));
            const auto size = part.attribute("font-size")
                                  ? numbers_.number(part.attribute("font-size").value())
                                  : group_size;
            pen.y() += part.attribute("dy").as_double();
            const TextExtent extent =
                text_extent(words, size, std::string_view(part.attribute("font-weight").value()) == "bold");
            if (!extent.ink.isEmpty()) text.box.extend(extent.ink.translated(pen));
            pen.x() += extent.width;
            text.words += words;
        };
        for (const pugi::xml_node part : line.children()) {
            add(part.type() == pugi::node_pcdata ? part.value() : part.text().get(), part);
        }
        if (text.box.isEmpty()) return;
        const std::string_view anchor = group.attribute("text-anchor").value();
        text.box.translate(Vector2d(anchor == "end"      ? -pen.x()
                                    : anchor == "middle" ? -0.5 * pen.x()
                                                         : 0.0,
                                    0.0));
        const std::string transform = group.attribute("transform").value();
        const std::string turn = transform_part(transform, "rotate");
        if (!turn.empty()) {
            const Eigen::Rotation2Dd rotation(numbers_.number(turn) * std::numbers::pi / 180.0);
            PixelBox turned;
            for (const auto corner :
                 {PixelBox::BottomLeft, PixelBox::BottomRight, PixelBox::TopLeft, PixelBox::TopRight}) {
                turned.extend(rotation * text.box.corner(corner));
            }
            text.box = turned;
        }
        text.box.translate(numbers_.place(transform_part(transform, "translate")));
        // A boxed label is drawn twice, the second time over its box.
        const bool again = std::ranges::any_of(picture.texts, [&](const SvgText& other) {
            return other.words == text.words && other.box.isApprox(text.box);
        });
        if (!again) picture.texts.push_back(text);
    }

    /// The key's sample stands beside the curve's text, the first of its group.
    void drop_key_sample(SvgCurve& curve, std::size_t first_text) const {
        if (first_text == picture.texts.size()) return;
        const PixelBox& key = picture.texts[first_text].box;
        const double size = picture.texts[first_text].size;
        const auto beside = [&](const Vector2d& place) {
            return std::abs(place.y() - key.center().y()) < 0.6 * size && !key.contains(place) &&
                   std::min(std::abs(place.x() - key.min().x()), std::abs(place.x() - key.max().x())) <
                       key_sample_gap * size;
        };
        const auto is_sample = [&](const Pixels& line) {
            return line.size() <= 2 && std::all_of(line.begin(), line.end(), beside);
        };
        // gnuplot draws the sample's lines before the data and its point after them.
        curve.lines.erase(curve.lines.begin(),
                          std::find_if_not(curve.lines.begin(), curve.lines.end(), is_sample));
        const auto mark = std::find_if(curve.marks.rbegin(), curve.marks.rend(), beside);
        if (mark != curve.marks.rend()) curve.marks.erase(std::next(mark).base());
    }

    static void join(std::vector<Pixels>& lines) {
        std::vector<Pixels> joined;
        for (const Pixels& line : lines) {
            if (!joined.empty() && (joined.back().back() - line.front()).norm() < same) {
                joined.back().insert(joined.back().end(), line.begin() + 1, line.end());
            } else {
                joined.push_back(line);
            }
        }
        lines = std::move(joined);
    }

    Numbers numbers_{picture.unreadable};
    std::vector<std::size_t> waiting_;  // curves whose frame comes after them
};

}  // namespace

SvgPicture read_svg(const std::filesystem::path& file) {
    pugi::xml_document document;
    if (!document.load_file(file.c_str(), pugi::parse_default | pugi::parse_ws_pcdata) ||
        !document.child("svg")) {
        throw std::runtime_error(file.string() + " is not an SVG picture");
    }
    const pugi::xml_node svg = document.child("svg");
    Reader reader;
    reader.picture.canvas = PixelBox(
        Vector2d::Zero(), Vector2d(svg.attribute("width").as_double(), svg.attribute("height").as_double()));
    reader.read(svg, nullptr);
    return reader.picture;
}

}  // namespace samara::test
