#include "samara/motion/description.hpp"

#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "samara/base/vector_json.hpp"

namespace samara {
namespace {

using nlohmann::json;

constexpr double degrees = 180.0 / std::numbers::pi;

json number_or_null(const std::optional<double>& value) {
    return value ? json(*value) : json(nullptr);
}

json describe(const BodyMotion& body, const BodyMeasures& measures) {
    json described = {{"name", body.name},
                      {"copies", body.copies},
                      {"triangles", body.surface.triangle_count()},
                      {"center_of_mass", as_json(body.center_of_mass)},
                      {"body_hash", body.body_hash},
                      {"models", body.models}};
    described.update(as_json(measures));
    return described;
}

std::string counted(int count, const char* noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string text_of(const BodyMotion& body, const BodyMeasures& measures) {
    std::string text = fmt::format("body {}: {}, {} triangles\n", body.name,
                                   body.copies == 1 ? "1 copy" : fmt::format("{} copies", body.copies),
                                   body.surface.triangle_count());
    text += as_text(measures);
    if (!body.models.empty()) text += fmt::format("  models: {}\n", body.models);
    if (!body.body_hash.empty()) text += fmt::format("  body file: hash {}\n", body.body_hash);
    return text;
}

std::string ensemble_text(const BodyMeasures& all) {
    std::string text =
        fmt::format("  of {}: {:.0f} % {} (95 % confidence: {:.0f}-{:.0f} %)", counted(all.samples, "flight"),
                    100.0 * all.regime_share, name_of(all.regime), 100.0 * all.regime_confidence[0],
                    100.0 * all.regime_confidence[1]);
    for (std::size_t i = 0; i < all.regime_counts.size(); ++i) {
        const auto regime = static_cast<Regime>(i);
        if (regime == all.regime || all.regime_counts[i] == 0) continue;
        text += fmt::format(", {} {}", all.regime_counts[i], name_of(regime));
    }
    text += fmt::format("\n  paths spread to {:.3g} m around their mean", all.path_spread);
    if (all.path_spread_growth) text += fmt::format(", like time^{:.2f}", *all.path_spread_growth);
    return text + "\n";
}

std::string landing_text(const Landing& landing, int samples) {
    std::string text = fmt::format("  landed at [{:.4g}, {:.4g}] m", landing.mean.x(), landing.mean.y());
    if (samples > 1) {
        text = fmt::format("  {} of {} landed around [{:.4g}, {:.4g}] m, {:.3g} m from it (rms)",
                           landing.count, samples, landing.mean.x(), landing.mean.y(), landing.spread);
        return text + fmt::format("; {} lie still\n", landing.at_rest);
    }
    return text + (landing.at_rest == 1 ? ", lies still\n" : "\n");
}

}  // namespace

json as_json(const Measures& measures) {
    return {{"window", {measures.window.begin, measures.window.end}},
            {"mean_velocity", as_json(measures.mean_velocity)},
            {"descent_speed", measures.descent_speed},
            {"mean_inclination", measures.mean_inclination},
            {"inclination_amplitude", measures.inclination_amplitude},
            {"frequency", number_or_null(measures.frequency)},
            {"rms_angular_speed", measures.rms_angular_speed},
            {"swings", measures.swings},
            {"turnovers", measures.turnovers},
            {"regime", name_of(measures.regime)}};
}

json as_json(const BodyMeasures& all) {
    json regimes;
    for (std::size_t i = 0; i < all.regime_counts.size(); ++i) {
        regimes[name_of(static_cast<Regime>(i))] = all.regime_counts[i];
    }
    json landing;
    if (all.landing.count > 0) {
        landing = {{"count", all.landing.count},
                   {"at_rest", all.landing.at_rest},
                   {"mean", as_json(all.landing.mean)},
                   {"spread", all.landing.spread}};
    }
    return {{"samples", all.samples},
            {"mean_velocity", as_json(all.mean_velocity)},
            {"descent_speed", all.descent_speed},
            {"descent_speed_deviation", all.descent_speed_deviation},
            {"descent_speed_error", all.descent_speed_error},
            {"mean_inclination", all.mean_inclination},
            {"inclination_amplitude", all.inclination_amplitude},
            {"frequency", number_or_null(all.frequency)},
            {"frequency_deviation", all.frequency_deviation},
            {"rms_angular_speed", all.rms_angular_speed},
            {"regime", name_of(all.regime)},
            {"regime_share", all.regime_share},
            {"regime_confidence", all.regime_confidence},
            {"regimes", regimes},
            {"path_spread", all.path_spread},
            {"path_spread_growth", number_or_null(all.path_spread_growth)},
            {"landing", landing}};
}

std::string as_text(const BodyMeasures& all) {
    const bool many = all.samples > 1;
    std::string text =
        fmt::format("  {}, descends at {:.4g}{} m/s, inclination up to {:.1f} degrees", name_of(all.regime),
                    all.descent_speed, many ? fmt::format(" +- {:.2g}", all.descent_speed_error) : "",
                    degrees * all.inclination_amplitude);
    if (all.frequency) text += fmt::format(", {:.4g} Hz", *all.frequency);
    text += fmt::format(", rms angular speed {:.4g} rad/s\n", all.rms_angular_speed);
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
            {"ground", number_or_null(motion.ground)},
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
