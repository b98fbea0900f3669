#include "samara/analysis/metrics/description.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "samara/core/base/numbers.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

using nlohmann::json;

double told_by(const MetricUncertainty& one) {
    return std::max(one.relative, one.chance);
}

json describe(const BodyMotion& body, const BodyMeasures& measures) {
    json described = {{"name", body.name},
                      {"copies", body.copies},
                      {"triangles", body.surface.triangle_count()},
                      {"center_of_mass", samara::as_json(body.center_of_mass)},
                      {"body_hash", body.body_hash},
                      {"models", body.models}};
    for (const MetricUncertainty& one : body.uncertainties) {
        described["uncertainties"][one.cause][one.metric] = told_by(one);
    }
    described.update(as_json(measures));
    return described;
}

std::string counted(int count, const char* noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

/// Returns a line for each cause: "  uncertain by its mesh: descent_speed 3.1 %, frequency 4 %".
std::string uncertainty_text(const BodyMotion& body) {
    std::string text;
    const std::string* cause = nullptr;
    for (const MetricUncertainty& one : body.uncertainties) {
        const bool begins = cause == nullptr || *cause != one.cause;
        if (begins) text += fmt::format("{}  uncertainty from its {}: ", text.empty() ? "" : "\n", one.cause);
        cause = &one.cause;
        text += fmt::format("{}{} {:.2g} %", begins ? "" : ", ", one.metric, 100.0 * told_by(one));
    }
    return text.empty() ? text : text + '\n';
}

std::string text_of(const BodyMotion& body, const BodyMeasures& measures) {
    std::string text = fmt::format("body {}: {}, {} triangles\n", body.name,
                                   body.copies == 1 ? "1 copy" : fmt::format("{} copies", body.copies),
                                   body.surface.triangle_count());
    text += as_text(measures);
    if (!body.models.empty()) text += fmt::format("  models: {}\n", body.models);
    text += uncertainty_text(body);
    if (!body.body_hash.empty()) text += fmt::format("  body file: hash {}\n", body.body_hash);
    return text;
}

std::string ensemble_text(const BodyMeasures& all) {
    const Regime commonest = all.regimes.commonest();
    const auto confidence = all.regimes.confidence();
    std::string text = fmt::format("  of {}: {:.0f} % {} (95 % confidence: {:.0f}-{:.0f} %)",
                                   counted(all.samples, "fall"), 100.0 * all.regimes.share(commonest),
                                   name_of(commonest), 100.0 * confidence[0], 100.0 * confidence[1]);
    for (std::size_t i = 0; i < all.regimes.counts.size(); ++i) {
        const auto regime = static_cast<Regime>(i);
        if (regime == commonest || all.regimes.of(regime) == 0) continue;
        text += fmt::format(", {} {}", all.regimes.of(regime), name_of(regime));
    }
    text += fmt::format("\n  paths spread to {:.3g} m around their mean", all.path_spread);
    if (all.path_spread_growth) text += fmt::format(", like time^{:.2f}", *all.path_spread_growth);
    return text + "\n";
}

/// Returns the metrics of the falls that autorotate, by the catalogue's names and units.
std::string autorotation_text(const BodyMeasures& all) {
    std::string text;
    for (const CataloguedMetric& entry : metric_catalogue) {
        if (!is_of_autorotation(entry.metric) || !all.metrics[entry.metric]) continue;
        text += fmt::format("{}{} {:.4g} {}", text.empty() ? "  " : ", ", entry.title,
                            entry.in_unit * all.value(entry.metric), entry.unit);
    }
    return text.empty() ? text : text + '\n';
}

std::string landing_text(const Landing& landing, int samples) {
    std::string text = fmt::format("  landed at [{:.4g}, {:.4g}] m", landing.mean.x(), landing.mean.y());
    if (samples > 1) {
        text = fmt::format("  {} of {} landed around [{:.4g}, {:.4g}] m, {:.3g} m from it (rms)",
                           landing.count, samples, landing.mean.x(), landing.mean.y(), landing.spread);
        return text + fmt::format("; {} at rest\n", landing.at_rest);
    }
    return text + (landing.at_rest == 1 ? ", at rest\n" : "\n");
}

}  // namespace

json as_json(const Measures& measures) {
    json result = {{"window", {measures.window.begin, measures.window.end}},
                   {"mean_velocity", as_json(measures.mean_velocity)},
                   {"swings", measures.swings},
                   {"turnovers", measures.turnovers},
                   {"regime", name_of(measures.regime)}};
    for (const CataloguedMetric& entry : metric_catalogue) {
        if (entry.measured) result[entry.key] = or_null(entry.measured(measures));
    }
    return result;
}

json as_json(const RegimeCounts& regimes) {
    json counts;
    for (std::size_t i = 0; i < regimes.counts.size(); ++i) {
        counts[name_of(static_cast<Regime>(i))] = regimes.counts[i];
    }
    return {{"regime", name_of(regimes.commonest())},
            {"regime_share", regimes.share(regimes.commonest())},
            {"regime_confidence", regimes.confidence()},
            {"regimes", counts}};
}

json as_json(const BodyMeasures& all) {
    json result = as_json(all.regimes);
    result["samples"] = all.samples;
    result["mean_velocity"] = as_json(all.mean_velocity);
    for (const CataloguedMetric& entry : metric_catalogue) {
        if (!entry.measured) continue;
        const std::optional<Estimate>& metric = all.metrics[entry.metric];
        result[entry.key] = metric ? json(metric->value) : json();
    }
    const std::optional<Estimate>& descent = all.metrics[Metric::descent_speed];
    const std::optional<Estimate>& frequency = all.metrics[Metric::frequency];
    result["descent_speed_deviation"] = descent->deviation.value_or(0.0);
    result["descent_speed_error"] = descent->error.value_or(0.0);
    result["frequency_deviation"] = frequency ? frequency->deviation.value_or(0.0) : 0.0;
    result["path_spread"] = all.path_spread;
    result["path_spread_growth"] = or_null(all.path_spread_growth);
    result["landing"] = nullptr;
    if (all.landing.count > 0) {
        result["landing"] = {{"count", all.landing.count},
                             {"at_rest", all.landing.at_rest},
                             {"mean", as_json(all.landing.mean)},
                             {"spread", all.landing.spread}};
    }
    return result;
}

std::string as_text(const BodyMeasures& all) {
    const bool many = all.samples > 1;
    const Estimate& descent = *all.metrics[Metric::descent_speed];
    std::string text =
        fmt::format("  {}, {} at {:.4g}{} m/s, inclination up to {:.1f} degrees",
                    name_of(all.regimes.commonest()), descent.value < 0.0 ? "rises" : "descends",
                    std::abs(descent.value), many ? fmt::format(" +- {:.2g}", *descent.error) : "",
                    degrees * all.value(Metric::inclination_amplitude));
    if (const auto& frequency = all.metrics[Metric::frequency])
        text += fmt::format(", {:.4g} Hz", frequency->value);
    text += fmt::format(", rms angular speed {:.4g} rad/s\n", all.value(Metric::rms_angular_speed));
    text += autorotation_text(all);
    if (many) text += ensemble_text(all);
    if (all.landing.count > 0) text += landing_text(all.landing, all.samples);
    return text;
}

json describe_motion(const Motion& motion, const std::vector<BodyMeasures>& measures) {
    json bodies = json::array();
    for (std::size_t i = 0; i < motion.bodies.size(); ++i) {
        bodies.push_back(describe(motion.bodies[i], measures[i]));
    }
    return {{"kind", "motion"},
            {"start", motion.times.front()},
            {"duration", motion.times.back() - motion.times.front()},
            {"frames", motion.frames()},
            {"frame_rate", motion.frame_rate},
            {"runs", motion.runs},
            {"gravity", as_json(motion.gravity)},
            {"ground", or_null(motion.ground)},
            {"seed", motion.seed},
            {"scene", motion.scene_text},
            {"bodies", bodies}};
}

std::string describe_motion_text(const Motion& motion, const std::vector<BodyMeasures>& measures) {
    std::string text = fmt::format(
        "motion: {} at {:g} per second, {:g} s; {}, seed {}\ngravity [{:g}, {:g}, {:g}] m/s^2\n",
        counted(motion.frames(), "frame"), motion.frame_rate, motion.times.back() - motion.times.front(),
        counted(motion.runs, "run"), motion.seed, motion.gravity.x(), motion.gravity.y(), motion.gravity.z());
    for (std::size_t i = 0; i < motion.bodies.size(); ++i) text += text_of(motion.bodies[i], measures[i]);
    return text;
}

}  // namespace samara
