#include "samara/analysis/comparison/reference_uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "samara/analysis/comparison/comparison.hpp"
#include "samara/core/base/error.hpp"
#include "samara/motion/motion_file.hpp"

namespace samara {
namespace {

void require_same_scene(const std::filesystem::path& reference, const Motion& a,
                        const std::filesystem::path& other, const Motion& b) {
    if (a.bodies.size() != 1 || b.bodies.size() != 1) {
        throw Error(fmt::format("{}: holds several bodies; give a motion of one body",
                                (a.bodies.size() != 1 ? reference : other).string()));
    }
    if (a.scene_text != b.scene_text) {
        throw Error(fmt::format("{}: is not from the same scene as {}; give a motion of the same scene",
                                other.string(), reference.string()));
    }
}

std::optional<MetricUncertainty> uncertainty_of(const MetricComparison& metric, const std::string& cause,
                                                const char* key) {
    if (!metric.motion && !metric.reference) return std::nullopt;
    if (!metric.relative) return MetricUncertainty{cause, key, 1.0};
    const double chance = metric.difference_error.value_or(0.0) / std::abs(metric.reference->value);
    return MetricUncertainty{cause, key, std::abs(*metric.relative), chance};
}

}  // namespace

std::vector<MetricUncertainty> uncertainty_beside(const std::filesystem::path& reference,
                                                  const std::filesystem::path& other,
                                                  const std::string& cause) {
    const MotionReader held(reference);
    const MotionReader beside(other);
    require_same_scene(reference, held.motion(), other, beside.motion());
    const Comparison comparison = compare({other.string(), &beside, 0, {}, {}},
                                          {reference.string(), &held, 0, {}, {}}, {}, [](double, double) {});
    std::vector<MetricUncertainty> uncertainties;
    for (const Metric metric : baked_metrics) {
        const CataloguedMetric& entry = catalogued(metric);
        if (entry.subject != MetricSubject::path && !comparison.judges_inclination) continue;
        const auto uncertainty = uncertainty_of(comparison.metrics[metric], cause, entry.key);
        if (uncertainty) uncertainties.push_back(*uncertainty);
    }
    if (comparison.judges_inclination) {
        uncertainties.push_back({cause, regime_key, comparison.regimes_agree ? 0.0 : 1.0});
    }
    std::ranges::sort(uncertainties, {}, &MetricUncertainty::metric);
    return uncertainties;
}

double uncertainty_of(const BodyMotion& body, const std::string& metric) {
    double sum = 0.0;
    double chance = 0.0;
    for (const MetricUncertainty& one : body.uncertainties) {
        if (one.metric != metric) continue;
        sum += one.relative;
        chance = std::max(chance, one.chance);
    }
    return std::max(sum, chance);
}

}  // namespace samara
