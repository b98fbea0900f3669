#include "samara/analysis/comparison/comparison_notes.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "samara/core/base/numbers.hpp"
#include "samara/core/surface/surface.hpp"

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

/// What one side gives reason to note, and what that means for either.
struct SideNote {
    std::string what;
    std::string meaning;
};

std::vector<SideNote> notes_of_side(const char* which, const FallChoice& choice, const FallSet& set) {
    std::vector<SideNote> notes;
    if (set.distinct < set.falls) {
        notes.push_back({fmt::format("of the {}'s {} falls {} differ{} from the others", which, set.falls,
                                     set.distinct, set.distinct == 1 ? "s" : ""),
                         "; falls that repeat others do not count"});
    }
    const auto& frequency = set.metrics[Metric::frequency];
    if (frequency && frequency->value > 0.0) {
        const double frames = 0.5 / frequency->value * choice.motion().frame_rate;
        if (frames < fewest_frames) {
            notes.push_back({fmt::format("the {} has {:.1f} frames for each swing", which, frames),
                             ": with fewer than six, turning points and angles are missed"});
        }
    }
    if (set.distinct > 1) return notes;
    if (set.pieces < 3) {
        notes.push_back(
            {fmt::format("the {}'s window shows too few swings to tell an error from them", which),
             "; give a longer fall or more runs"});
    } else if (set.pieces < few_pieces) {
        notes.push_back(
            {fmt::format("the {}'s errors rest on {} swings", which, set.pieces), ": they are rough"});
    }
    return notes;
}

/// Both sides' notes; what is of one kind in one sentence.
void note_sides(Notes& notes, const std::vector<SideNote>& motion, std::vector<SideNote> reference) {
    for (const SideNote& one : motion) {
        const auto same = std::ranges::find(reference, one.meaning, &SideNote::meaning);
        if (same == reference.end()) {
            notes.push_back(one.what + one.meaning);
            continue;
        }
        notes.push_back(fmt::format("{}, {}{}", one.what, same->what, one.meaning));
        reference.erase(same);
    }
    for (const SideNote& one : reference) notes.push_back(one.what + one.meaning);
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
    note_sides(notes, notes_of_side("motion", motion, comparison.motion),
               notes_of_side("reference", reference, comparison.reference));
    return notes;
}

}  // namespace samara
