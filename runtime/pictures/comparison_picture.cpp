#include "samara/pictures/comparison_picture.hpp"

#include <algorithm>
#include <cmath>

#include "samara/formats/vector_json.hpp"

namespace samara {
namespace {

using nlohmann::json;

constexpr double most_swings = 24.0;
constexpr std::size_t most_points = 4000;

double drawn_time(const Comparison& all) {
    const double common = std::min(all.motion_lengths.shortest, all.reference_lengths.shortest);
    const auto& frequency = all.reference.metrics[Metric::frequency];
    return frequency ? std::min(common, most_swings * 0.5 / frequency->value) : common;
}

json fall_as_json(const FallSeries& fall, double end) {
    json result;
    const std::size_t stride = 1 + fall.times.size() / most_points;
    for (std::size_t i = 0; i < fall.times.size() && fall.times[i] <= end; i += stride) {
        result["times"].push_back(fall.times[i]);
        result["paths"].push_back(as_json(fall.displacements[i]));
        result["inclinations"].push_back(fall.inclinations[i]);
    }
    return result;
}

json share_of_time(const FallSet& set) {
    InclinationHistogram shares{};
    double all = 0.0;
    for (const auto& fall : set.histograms) {
        for (const InclinationHistogram& piece : fall) {
            for (std::size_t i = 0; i < piece.size(); ++i) {
                shares[i] += piece[i];
                all += piece[i];
            }
        }
    }
    for (double& share : shares) share /= all;
    return shares;
}

json side_as_json(const FallSet& set, const std::string& file, double end) {
    const auto& frequency = set.metrics[Metric::frequency];
    json result = {{"file", file},
                   {"regime", name_of(set.regimes.commonest())},
                   {"distinct", set.distinct},
                   {"falls", json::array({fall_as_json(set.example, end)})},
                   {"spectrum", set.spectrum.power},
                   {"spectrum_step", set.spectrum.step},
                   {"frequency", frequency ? json(frequency->value) : json()},
                   {"distribution", share_of_time(set)}};
    for (const FallSeries& fall : set.more) result["falls"].push_back(fall_as_json(fall, end));
    return result;
}

}  // namespace

json comparison_picture(const Comparison& all, const std::string& motion, const std::string& reference) {
    const double end = drawn_time(all);
    json picture = {{"picture", "comparison"},
                    {"name", all.motion_body},
                    {"motion", side_as_json(all.motion, motion, end)},
                    {"reference", side_as_json(all.reference, reference, end)},
                    {"end", end},
                    {"window", {all.window.begin, all.window.end}},
                    {"judges_inclination", all.judges_inclination},
                    {"regimes_agree", all.regimes_agree},
                    {"agrees", all.agrees},
                    {"certain", all.certain},
                    {"first_swing_end", or_null(all.first_swing.end)},
                    {"distance", all.distribution.distance},
                    {"probability", nullptr}};
    if (all.distribution.chance) picture["probability"] = all.distribution.chance->probability;
    for (const Metric metric : compared_metrics) {
        const MetricComparison& one = all.metrics[metric];
        json error;
        if (one.difference_error && one.reference) {
            error = *one.difference_error / std::abs(one.reference->value);
        }
        picture["differences"].push_back(
            {{"name", catalogued(metric).heading}, {"relative", or_null(one.relative)}, {"error", error}});
    }
    return picture;
}

}  // namespace samara
