#include "internal/comparison/comparison_notes.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "internal/base/angles.hpp"
#include "samara/body/surface.hpp"

namespace samara {
namespace {

constexpr double same_length = 0.01;
constexpr double same_area = 0.05;
constexpr double same_start = 2.0 * degree;
constexpr double fewest_frames = 6.0;
constexpr std::size_t few_pieces = 5;

using Notes = std::vector<std::string>;

void note_lengths(Notes& notes, const Comparison& all) {
    const double a = all.motion_lengths.shortest;
    const double b = all.reference_lengths.shortest;
    if (std::abs(a - b) <= same_length * std::max(a, b)) return;
    notes.push_back(
        fmt::format("the motion's falls last {:.4g} s or more, the reference's {:.4g} s: only what both "
                    "cover is compared",
                    a, b));
}

void note_side(Notes& notes, const char* which, const FallChoice& choice, const FallSet& set) {
    if (set.distinct < set.falls) {
        notes.push_back(fmt::format(
            "of the {}'s {} falls {} differ{} from the others; the rest repeat {} and "
            "do not count",
            which, set.falls, set.distinct, set.distinct == 1 ? "s" : "", set.distinct == 1 ? "it" : "them"));
    }
    const auto& frequency = set.figures[Figure::frequency];
    if (frequency && frequency->value > 0.0) {
        const double frames = 0.5 / frequency->value * choice.motion().frame_rate;
        if (frames < fewest_frames) {
            notes.push_back(fmt::format(
                "the {} has {:.1f} frames for each swing: with fewer than six, turning points and "
                "angles are missed",
                which, frames));
        }
    }
    if (set.distinct > 1) return;
    if (set.pieces < 3) {
        notes.push_back(
            fmt::format("the {}'s window shows too few swings to tell an error from them; give a longer fall "
                        "or more runs",
                        which));
    } else if (set.pieces < few_pieces) {
        notes.push_back(fmt::format("the {}'s errors rest on {} swings and are rough", which, set.pieces));
    }
}

void note_starts(Notes& notes, const Comparison& all) {
    const FallSeries& a = all.motion.example;
    const FallSeries& b = all.reference.example;
    const double angle = std::acos(std::clamp(std::abs(a.axes.front().dot(b.axes.front())), 0.0, 1.0));
    if (angle <= same_start) return;
    notes.push_back(fmt::format(
        "the shortest axes are {:.0f} degrees apart at the release: the first swings and paths start "
        "differently",
        degrees * angle));
}

void note_shapes(Notes& notes, const FallChoice& motion, const FallChoice& reference) {
    const double a = surface_area(motion.of_body().surface);
    const double b = surface_area(reference.of_body().surface);
    if (std::abs(a - b) <= same_area * std::max(a, b)) return;
    notes.push_back(fmt::format(
        "the bodies are not the same: the motion's has a surface of {:.4g} m^2, the reference's {:.4g} m^2",
        a, b));
}

}  // namespace

std::vector<std::string> comparison_notes(const FallChoice& motion, const FallChoice& reference,
                                          const Comparison& comparison) {
    Notes notes;
    note_shapes(notes, motion, reference);
    if (!comparison.judges_inclination) {
        notes.emplace_back(
            "no axis of the body is shorter than the others: the inclination is that of an axis chosen by "
            "chance, and only the descent speed is judged");
    }
    if (comparison.judges_inclination) note_starts(notes, comparison);
    note_lengths(notes, comparison);
    note_side(notes, "motion", motion, comparison.motion);
    note_side(notes, "reference", reference, comparison.reference);
    return notes;
}

}  // namespace samara
