#include "samara/analysis/comparison/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "samara/analysis/comparison/reference_uncertainty.hpp"
#include "samara/analysis/metrics/estimate.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/base/numbers.hpp"
#include "samara/core/surface/surface.hpp"
#include "samara/motion/inclination.hpp"

namespace samara {
namespace {

constexpr double same_length = 0.01;
constexpr double same_area = 0.05;
constexpr double same_start = 2.0 * degree;
constexpr double fewest_frames = 6.0;
constexpr std::size_t few_pieces = 5;
// Falls of which fewer are of one regime have none.
constexpr double least_share_of_regime = 0.9;
// The drift speed of irregular falls may differ by so many tolerances of the descent speed, of that speed.
constexpr double drift_over_descent = 2.0;

using Notes = std::vector<std::string>;

void note_lengths(Notes& notes, const Comparison& all) {
    const double a = all.motion_lengths.shortest;
    const double b = all.reference_lengths.shortest;
    if (std::abs(a - b) <= same_length * std::max(a, b)) return;
    notes.push_back(
        fmt::format("the motion's falls last {:.4g} s or more, the reference's {:.4g} s: only the common "
                    "part is compared",
                    a, b));
}

/// A note about one side, and its meaning for the comparison.
struct SideNote {
    std::string what;
    std::string meaning;
};

std::vector<SideNote> notes_of_side(const char* which, const FallChoice& choice, const FallSet& set) {
    std::vector<SideNote> notes;
    if (set.distinct < set.falls) {
        notes.push_back({fmt::format("the {} has {} falls, of which {} {} distinct", which, set.falls,
                                     set.distinct, set.distinct == 1 ? "is" : "are"),
                         "; duplicates are not counted"});
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
        notes.push_back({fmt::format("the {}'s window has too few swings to estimate an error", which),
                         "; give a longer fall or more runs"});
    } else if (set.pieces < few_pieces) {
        notes.push_back({fmt::format("the {}'s errors are estimated from {} swings", which, set.pieces),
                         ": they are rough"});
    }
    return notes;
}

/// Adds both sides' notes, those of one subject in one sentence.
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
        "the bodies differ: the motion's has a surface of {:.4g} m^2, the reference's {:.4g} m^2", a, b));
}

/// Returns limits of a comparison's validity, a sentence each without a full stop: falls of different length,
/// runs that repeat one another, other starts, other shapes, too few frames or swings.
std::vector<std::string> comparison_notes(const FallChoice& motion, const FallChoice& reference,
                                          const Comparison& comparison) {
    Notes notes;
    note_shapes(notes, motion, reference);
    if (!comparison.judges_inclination) {
        notes.emplace_back(
            "no axis of the body is shorter than the others: the inclination refers to an arbitrary axis, "
            "and only the descent speed is judged");
    }
    if (comparison.judges_inclination) note_starts(notes, comparison);
    note_lengths(notes, comparison);
    note_sides(notes, notes_of_side("motion", motion, comparison.motion),
               notes_of_side("reference", reference, comparison.reference));
    return notes;
}

constexpr double swings_in_segment = 16.0;
constexpr double same_gravity = 1e-4;
constexpr double rounding = 1e-9;

void require_same_gravity(const FallChoice& motion, const FallChoice& reference) {
    const Vector3d& a = motion.motion().gravity;
    const Vector3d& b = reference.motion().gravity;
    if ((a - b).norm() <= same_gravity * std::max(a.norm(), b.norm())) return;
    throw Error(
        fmt::format("{} has the gravity [{:g}, {:g}, {:g}] m/s^2, {} has [{:g}, {:g}, {:g}]: they cannot be "
                    "compared; simulate both with the same gravity",
                    motion.name, a.x(), a.y(), a.z(), reference.name, b.x(), b.y(), b.z()));
}

void require_length(const FallChoice& choice, const FallLengths& lengths) {
    if (lengths.shortest > 0.0) return;
    throw Error(fmt::format("{}: a fall of '{}' has a single frame; simulate for longer", choice.name,
                            choice.of_body().name));
}

TimeWindow window_of(const FallChoice& motion, const FallLengths& motion_lengths, const FallChoice& reference,
                     const FallLengths& reference_lengths, const std::optional<TimeWindow>& asked) {
    const double common = std::min(motion_lengths.shortest, reference_lengths.shortest);
    if (!asked) return {common / 3.0, common};
    if (asked->begin >= 0.0 && asked->begin < asked->end && asked->end <= common * (1.0 + 1e-9))
        return *asked;
    throw Error(
        fmt::format("the window from {:g} s to {:g} s after the release is not within both falls: {} lasts "
                    "{:.4g} s, {} lasts {:.4g} s; give another --window",
                    asked->begin, asked->end, motion.name, motion_lengths.shortest, reference.name,
                    reference_lengths.shortest));
}

/// Returns the measures of the first fall of a choice.
Measures first_measures(const FallChoice& choice, const TimeWindow& window) {
    FallChoice first = choice;
    first.run = choice.run.value_or(0);
    first.copy = choice.copy.value_or(0);
    Measures measures;
    for_each_fall(first, [&](const Motion& part, int run, int copy) {
        measures = fall_series(part, part.bodies[0], run, copy, window).measures;
    });
    return measures;
}

/// Returns the length (s) of the spectra's segments, the same for both: long enough to resolve frequencies,
/// short enough to have many in a long window.
double segment_of(const FallChoice& motion, const FallChoice& reference, const TimeWindow& window) {
    const double length = window.end - window.begin;
    for (const FallChoice* choice : {&reference, &motion}) {
        const auto frequency = first_measures(*choice, window).frequency;
        if (frequency) return std::min(length, swings_in_segment * 0.5 / *frequency);
    }
    return length;
}

/// Returns the error of an estimate in a comparison; for a single fall it is at least the scatter of the
/// others.
std::optional<double> error_beside(const Estimate& one, const Estimate& other) {
    if (one.deviation || !other.deviation) return one.error;
    return std::max(one.error.value_or(0.0), *other.deviation);
}

MetricComparison compare_turn(const std::optional<TurningPoint>& motion,
                              const std::optional<TurningPoint>& reference, Estimate TurningPoint::*metric) {
    return compare_metric(motion ? std::optional((*motion).*metric) : std::nullopt,
                          reference ? std::optional((*reference).*metric) : std::nullopt);
}

/// Returns quarters of the depth (m) that all falls reach; none where one does not sink.
std::vector<double> levels_of(const FallLengths& motion, const FallLengths& reference) {
    const double depth = (1.0 - rounding) * std::min(motion.shallowest, reference.shallowest);
    if (!(depth > 0.0)) return {};
    return {0.25 * depth, 0.5 * depth, 0.75 * depth, depth};
}

void compare_all_landings(Comparison& all, const std::vector<double>& depths) {
    for (std::size_t i = 0; i < depths.size(); ++i) {
        const std::vector<Passage>& motion = all.motion.passages[i];
        const std::vector<Passage>& reference = all.reference.passages[i];
        if (std::min(motion.size(), reference.size()) < fewest_landings) return;
        all.landings.push_back(compare_landings(depths[i], motion, reference));
    }
}

void compare_first_swings(Comparison& all) {
    const FirstSwing& a = all.motion.first_swing;
    const FirstSwing& b = all.reference.first_swing;
    all.first_swing.minimum_time = compare_turn(a.minimum, b.minimum, &TurningPoint::time);
    all.first_swing.minimum_inclination = compare_turn(a.minimum, b.minimum, &TurningPoint::inclination);
    all.first_swing.maximum_time = compare_turn(a.maximum, b.maximum, &TurningPoint::time);
    all.first_swing.maximum_inclination = compare_turn(a.maximum, b.maximum, &TurningPoint::inclination);
}

/// Returns why a side's falls tell no single frequency, amplitude or regime; empty where they do.
std::string irregularity_of(const char* which, const FallSet& set) {
    const Regime commonest = set.regimes.commonest();
    if (commonest == Regime::chaotic) return fmt::format("the {} is chaotic", which);
    const double share = set.regimes.share(commonest);
    if (share >= least_share_of_regime) return {};
    return fmt::format("{:.0f} % of the {}'s falls are {}, the others are not", 100.0 * share, which,
                       name_of(commonest));
}

std::string irregularity_of(const Comparison& all) {
    if (!all.judges_inclination) return {};
    if (all.regime_is_uncertain) return "the reference's regime depends on its mesh or closure";
    const std::string of_reference = irregularity_of("reference", all.reference);
    return of_reference.empty() ? irregularity_of("motion", all.motion) : of_reference;
}

Verdict verdict_on(const DistributionDistance& distance) {
    const double by_chance = distance.chance ? distance.chance->mean : 0.0;
    const double beyond = distance.distance - by_chance;
    Verdict verdict{.limit = by_chance + largest_distribution_distance};
    verdict.agrees = beyond <= largest_distribution_distance;
    verdict.certain = distance.chance && std::abs(beyond - largest_distribution_distance) >=
                                             distance.chance->limit - distance.chance->mean;
    return verdict;
}

/// Sums up verdicts: all must agree.
struct Judgement {
    bool agrees = true;
    bool all_certain = true;
    bool surely_differs = false;

    void add(const std::optional<Verdict>& verdict) {
        if (!verdict) return;
        agrees = agrees && verdict->agrees;
        all_certain = all_certain && verdict->certain;
        surely_differs = surely_differs || (!verdict->agrees && verdict->certain);
    }
    [[nodiscard]] bool certain() const { return agrees ? all_certain : surely_differs; }
};

void judge_by_metrics(Comparison& all) {
    Judgement judgement;
    if (all.judges_inclination) {
        const bool decides = !all.regime_is_uncertain;
        judgement.add(Verdict{0.0, all.regimes_agree || !decides, decides});
    }
    for (const Metric metric : compared_metrics) judgement.add(all.metrics[metric].verdict);
    all.agrees = all.agrees_by_metrics = judgement.agrees;
    all.certain = judgement.certain();
}

void judge_by_distributions(Comparison& all, const PerMetric<double>& tolerances) {
    const double speed = all.reference.metrics[Metric::descent_speed]->value;
    MetricComparison& drift = all.metrics[Metric::drift_speed];
    drift = compare_metric(drift.motion, drift.reference, 0.0,
                           drift_over_descent * tolerances[Metric::descent_speed] * std::abs(speed));
    Judgement judgement;
    judgement.add(all.metrics[Metric::descent_speed].verdict);
    judgement.add(drift.verdict);
    for (DistributionComparison& one : all.distributions) {
        one.verdict = verdict_on(one.distance);
        // What the regime of a reference depends on, its distributions do too.
        one.verdict->certain = one.verdict->certain && !all.regime_is_uncertain;
        judgement.add(one.verdict);
    }
    all.agrees = judgement.agrees;
    all.certain = judgement.certain();
}

void compare_metrics(Comparison& all, const BodyMotion& reference, const PerMetric<double>& tolerances) {
    PerMetric<std::optional<double>> judged;
    for (const Metric metric : compared_metrics) {
        if (all.judges_inclination || catalogued(metric).subject != MetricSubject::inclination) {
            judged[metric] = tolerances[metric];
        }
    }
    for (const CataloguedMetric& entry : metric_catalogue) {
        const Metric metric = entry.metric;
        all.metrics[metric] =
            compare_metric(all.motion.metrics[metric], all.reference.metrics[metric], judged[metric],
                           entry.allowed.always, uncertainty_of(reference, entry.key));
    }
    for (std::size_t q = 0; q < quantile_percents.size(); ++q) {
        all.quantiles[q] =
            compare_metric(all.motion.inclination_quantiles[q], all.reference.inclination_quantiles[q]);
    }
    all.regime_is_uncertain = uncertainty_of(reference, regime_key) > 0.0;
    for (std::size_t i = 0; i < all.distributions.size(); ++i) {
        all.distributions[i].distance =
            distribution_distance(all.motion.histograms[i], all.reference.histograms[i]);
    }
    all.regimes_agree = all.motion.regimes.commonest() == all.reference.regimes.commonest();
    judge_by_metrics(all);
    all.irregular_because = irregularity_of(all);
    if (!all.irregular_because.empty()) judge_by_distributions(all, tolerances);
}

}  // namespace

MetricComparison compare_metric(const std::optional<Estimate>& motion,
                                const std::optional<Estimate>& reference,
                                const std::optional<double>& tolerance, double least_limit,
                                double uncertainty) {
    MetricComparison result;
    result.motion = motion;
    result.reference = reference;
    if (!motion && !reference) return result;
    if (!motion || !reference) {
        // One with a frequency and one without differ, unless the reference itself may have it or not.
        const bool undecided = uncertainty >= 1.0;
        if (tolerance) result.verdict = Verdict{0.0, undecided, !undecided};
        return result;
    }
    const double magnitude = std::abs(reference->value);
    result.difference = motion->value - reference->value;
    result.reference_uncertainty = uncertainty * magnitude;
    if (magnitude > 0.0) result.relative = *result.difference / magnitude;
    const auto motion_error = error_beside(*motion, *reference);
    const auto reference_error = error_beside(*reference, *motion);
    if (motion_error && reference_error) {
        result.difference_error = std::hypot(*motion_error, *reference_error);
        // Errors of regular motions can be rounding alone.
        if (*result.difference_error > rounding * std::max(std::abs(motion->value), magnitude)) {
            result.in_errors = std::abs(*result.difference) / *result.difference_error;
        }
    }
    if (!tolerance) return result;
    Verdict verdict;
    verdict.limit = std::max(*tolerance * magnitude, least_limit);
    const double beyond = std::abs(*result.difference) - result.reference_uncertainty;
    const double at_most = std::abs(*result.difference) + result.reference_uncertainty;
    verdict.agrees = beyond <= verdict.limit;
    const double to_limit = verdict.agrees ? verdict.limit - at_most : beyond - verdict.limit;
    verdict.certain = result.difference_error && to_limit >= certain_errors * *result.difference_error;
    result.verdict = verdict;
    return result;
}

Comparison compare(const FallChoice& motion, const FallChoice& reference, const ComparisonSettings& settings,
                   const std::function<void(double, double)>& progress) {
    require_same_gravity(motion, reference);
    Comparison all;
    all.motion_body = motion.of_body().name;
    all.reference_body = reference.of_body().name;
    all.judges_inclination =
        has_shortest_axis(motion.of_body().surface) && has_shortest_axis(reference.of_body().surface);
    all.motion_lengths = fall_lengths(motion);
    all.reference_lengths = fall_lengths(reference);
    require_length(motion, all.motion_lengths);
    require_length(reference, all.reference_lengths);
    all.window = window_of(motion, all.motion_lengths, reference, all.reference_lengths, settings.window);
    const FallWindow window{all.window, segment_of(motion, reference, all.window),
                            levels_of(all.motion_lengths, all.reference_lengths)};

    const double total = motion.runs() * motion.copies() + reference.runs() * reference.copies();
    double done = 0.0;
    const auto count = [&] { progress(++done, total); };
    all.reference = measure_falls(reference, window, std::nullopt, count);
    all.first_swing.end = end_of(all.reference.first_swing);
    FallSeries path = all.reference.example;
    path.displacements = all.reference.mean_displacements;
    if (all.first_swing.end) {
        *all.first_swing.end = std::min(
            *all.first_swing.end, std::min(all.motion_lengths.shortest, all.reference_lengths.shortest));
        all.motion = measure_falls(motion, window, std::pair(&path, *all.first_swing.end), count);
        all.first_swing.path_distance = all.motion.path_distance;
        all.first_swing.distance_fallen = displacement_at(path, *all.first_swing.end).dot(path.down);
    } else {
        all.motion = measure_falls(motion, window, std::nullopt, count);
    }
    compare_first_swings(all);
    compare_all_landings(all, window.depths);
    compare_metrics(all, reference.of_body(), settings.tolerances);
    all.notes = comparison_notes(motion, reference, all);
    return all;
}

}  // namespace samara
