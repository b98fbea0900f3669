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

json describe(const Motion& motion, const BodyMotion& body) {
    const BodyMeasures all = measure_all(motion, body);
    return {{"name", body.name},
            {"copies", body.copies},
            {"triangles", body.surface.triangle_count()},
            {"center_of_mass", as_json(body.center_of_mass)},
            {"body_hash", body.body_hash},
            {"models", body.models},
            {"mean_velocity", as_json(all.mean_velocity)},
            {"descent_speed", all.descent_speed},
            {"descent_speed_deviation", all.descent_speed_deviation},
            {"inclination_amplitude", all.inclination_amplitude},
            {"frequency", number_or_null(all.frequency)},
            {"rms_angular_speed", all.rms_angular_speed},
            {"regime", name_of(all.regime)},
            {"regime_share", all.regime_share}};
}

std::string counted(int count, const char* noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string text_of(const Motion& motion, const BodyMotion& body) {
    const BodyMeasures all = measure_all(motion, body);
    const bool many = motion.runs * body.copies > 1;
    std::string text = fmt::format("body {}: {}, {} triangles\n", body.name,
                                   body.copies == 1 ? "1 copy" : fmt::format("{} copies", body.copies),
                                   body.surface.triangle_count());
    text += fmt::format("  {}{}, descent speed {:.4g}{} m/s, inclination up to {:.1f} degrees",
                        name_of(all.regime),
                        many ? fmt::format(" ({:.0f} % of them)", 100.0 * all.regime_share) : "",
                        all.descent_speed, many ? fmt::format(" +- {:.2g}", all.descent_speed_deviation) : "",
                        degrees * all.inclination_amplitude);
    if (all.frequency) text += fmt::format(", {:.4g} Hz", *all.frequency);
    text += fmt::format("\n  rms angular speed {:.4g} rad/s\n", all.rms_angular_speed);
    if (!body.models.empty()) text += fmt::format("  models: {}\n", body.models);
    if (!body.body_hash.empty()) text += fmt::format("  body file: hash {}\n", body.body_hash);
    return text;
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

json describe_motion(const Motion& motion) {
    json bodies = json::array();
    for (const BodyMotion& body : motion.bodies) bodies.push_back(describe(motion, body));
    return {{"kind", "motion"},
            {"start", motion.times.front()},
            {"duration", motion.times.back() - motion.times.front()},
            {"frames", motion.frames()},
            {"frame_rate", motion.frame_rate},
            {"runs", motion.runs},
            {"gravity", as_json(motion.gravity)},
            {"seed", motion.seed},
            {"scene", motion.scene_text},
            {"bodies", bodies}};
}

std::string describe_motion_text(const Motion& motion) {
    std::string text = fmt::format(
        "motion: {} at {:g} per second, {:g} s; {}, seed {}\ngravity [{:g}, {:g}, {:g}] m/s^2\n",
        counted(motion.frames(), "frame"), motion.frame_rate, motion.times.back() - motion.times.front(),
        counted(motion.runs, "run"), motion.seed, motion.gravity.x(), motion.gravity.y(), motion.gravity.z());
    for (const BodyMotion& body : motion.bodies) text += text_of(motion, body);
    return text;
}

}  // namespace samara
