#include "samara/pictures/motion_pictures.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "samara/analysis/metrics/description.hpp"
#include "samara/analysis/metrics/tilt.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/surface/curved_surface.hpp"
#include "samara/export/shaded_mesh.hpp"
#include "samara/formats/json_text.hpp"
#include "samara/motion/inclination.hpp"
#include "samara/motion/measures.hpp"

namespace samara {
namespace {

using nlohmann::json;

constexpr std::size_t most_paths = 200;
constexpr int most_path_points = 240;

json of_one_copy(const char* picture, const Motion& motion, const BodyMotion& body, int run, int copy) {
    return {{"picture", picture},
            {"name", body.name},
            {"run", run},
            {"runs", motion.runs},
            {"copy", copy},
            {"copies", body.copies},
            {"measures", as_json(measure(motion, body, run, copy))}};
}

/// Returns the data of a strip, with the frames of the fall and a little before and after it: a body may wait
/// long, and lie long on the ground.
json strip(const Motion& motion, const BodyMotion& body, int run, int copy) {
    json picture = of_one_copy("strip", motion, body, run, copy);
    const TimeWindow fall = fall_of(motion, body, run, copy);
    const double length = fall.end - fall.begin;
    const Vector3d down = down_direction(motion.gravity);
    picture["fall"] = {fall.begin, fall.end};
    for (int frame = 0; frame < motion.frames(); ++frame) {
        const double time = motion.times[static_cast<std::size_t>(frame)];
        if (time < fall.begin - 0.1 * length || time > fall.end + 0.25 * length) continue;
        const Pose& pose = motion.pose(body, run, frame, copy);
        const auto& orientation = pose.orientation;
        picture["times"].push_back(time);
        picture["position"].push_back(as_json(pose.position));
        picture["orientation"].push_back(
            {orientation.x(), orientation.y(), orientation.z(), orientation.w()});
        picture["descent_speed"].push_back(pose.velocity.dot(down));
        picture["inclination"].push_back(inclination(motion, body, pose));
        picture["angular_velocity"].push_back(as_json(pose.angular_velocity));
    }
    const Surface flat = flattened_surface(body.surface);
    const double size = body.size(run, copy);
    for (const Vector3d& vertex : flat.vertices) {
        picture["vertices"].push_back(as_json(Vector3d(size * (vertex - body.center_of_mass))));
    }
    picture["triangles"] = flat.corners;
    return picture;
}

/// Returns the data of a strip with the fluid's forces.
json forces(const Motion& motion, const BodyMotion& body, int run, int copy) {
    if (body.forces.empty()) {
        throw Error(fmt::format("'{}': the motion holds no forces; simulate it with --forces", body.name));
    }
    json picture = strip(motion, body, run, copy);
    picture["picture"] = "forces";
    const auto& times = picture["times"];
    for (int frame = 0; frame < motion.frames(); ++frame) {
        const double time = motion.times[static_cast<std::size_t>(frame)];
        if (time < times.front().get<double>() || time > times.back().get<double>()) continue;
        const FluidForces& all = body.forces[motion.index(body, run, frame, copy)];
        for (const auto& [name, part] : parts_of_fluid_forces) {
            picture["force"][name].push_back(as_json((all.*part).force));
            picture["moment"][name].push_back(as_json((all.*part).moment));
        }
    }
    return picture;
}

json phase(const Motion& motion, const BodyMotion& body, int run, int copy) {
    if (!has_shortest_axis(body.surface)) {
        throw Error(fmt::format(
            "'{}' has no shortest axis, so a phase portrait is not possible; use --kind strip", body.name));
    }
    json picture = of_one_copy("phase", motion, body, run, copy);
    const Tilt tilt = tilt_of(motion, body, run, copy);
    double highest = 0.0;
    for (const double rate : tilt.rate) highest = std::max(highest, std::abs(rate));
    picture["times"] = tilt.times;
    picture["angle"] = tilt.angle;
    picture["rate"] = tilt.rate;
    picture["continues"] = tilt.continues;
    picture["fall"] = {tilt.times.front(), tilt.times.back()};
    picture["highest_rate"] = highest;
    picture["lines"] = std::ranges::count(tilt.continues, false);
    const json& frequency = picture["measures"]["frequency"];
    const bool swings = frequency.is_number() && frequency.get<double>() > 0.0;
    picture["frames_in_swing"] = swings ? json(0.5 / frequency.get<double>() * motion.frame_rate) : json();
    return picture;
}

/// The place where one copy lands in one run.
struct Place {
    int run;
    int copy;
    int frame;
    Vector3d position;  ///< m
    double value;       ///< s: time of landing; without a landing m: the distance descended
};

/// Returns the landings; where there is none, the places at the last frame.
std::vector<Place> places_of(const Motion& motion, const BodyMotion& body, bool& landed) {
    std::vector<Place> landings;
    std::vector<Place> last;
    const Vector3d down = down_direction(motion.gravity);
    for (int run = 0; run < motion.runs; ++run) {
        for (int copy = 0; copy < body.copies; ++copy) {
            const auto at = [&](int frame) { return motion.pose(body, run, frame, copy).position; };
            if (const auto frame = landing_frame(motion, body, run, copy)) {
                landings.push_back(
                    {run, copy, *frame, at(*frame), motion.times[static_cast<std::size_t>(*frame)]});
            }
            const int end = motion.frames() - 1;
            last.push_back({run, copy, end, at(end), (at(end) - at(0)).dot(down)});
        }
    }
    landed = !landings.empty();
    return landed ? landings : last;
}

json landing(const Motion& motion, const BodyMotion& body) {
    bool landed = false;
    const std::vector<Place> places = places_of(motion, body, landed);
    if (places.size() < 2) {
        throw Error(fmt::format(
            "'{}': a landing map needs more than one {}; simulate with --runs N, or a count in the scene",
            body.name, landed ? "landing" : "fall"));
    }
    const auto count = static_cast<double>(places.size());
    Vector3d mean = Vector3d::Zero();
    for (const Place& place : places) mean += place.position / count;
    std::vector<double> distances;
    double squares = 0.0;
    json picture = {{"picture", "landing"},
                    {"name", body.name},
                    {"runs", motion.runs},
                    {"copies", body.copies},
                    {"end", motion.times.back()}};
    for (const Place& place : places) {
        const double square = (place.position - mean).head<2>().squaredNorm();
        squares += square;
        distances.push_back(std::sqrt(square));
        picture["places"].push_back({place.position.x(), place.position.y()});
        picture["values"].push_back(place.value);
    }
    const std::size_t stride = 1 + (places.size() - 1) / most_paths;
    for (std::size_t i = 0; i < places.size(); i += stride) {
        const Place& place = places[i];
        json path = json::array();
        const int step = 1 + place.frame / most_path_points;
        for (int frame = place.frame % step; frame <= place.frame; frame += step) {
            const Vector3d& at = motion.pose(body, place.run, frame, place.copy).position;
            path.push_back({at.x(), at.y()});
        }
        picture["paths"].push_back(path);
    }
    double radius = 0.0;
    for (const Vector3d& vertex : body.surface.vertices) {
        radius = std::max(radius, (vertex - body.center_of_mass).norm());
    }
    if (!body.sizes.empty()) radius *= *std::ranges::max_element(body.sizes);
    picture["radius"] = radius;
    picture["samples"] = motion.runs * body.copies;
    picture["landed"] = landed ? places.size() : 0;
    picture["mean"] = as_json(mean);
    picture["spread"] = std::sqrt(squares / count);
    picture["median"] = percentile(distances, 50.0);
    return picture;
}

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
    std::array<double, inclination_bins> shares{};
    double all = 0.0;
    for (const auto& fall : set.histograms[static_cast<std::size_t>(Distribution::inclination)]) {
        for (const Histogram& piece : fall) {
            for (std::size_t i = 0; i < shares.size(); ++i) {
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

json motion_picture(const std::string& picture, const Motion& motion, const BodyMotion& body, int run,
                    int copy) {
    if (picture == "landing") return landing(motion, body);
    if (picture == "forces") return forces(motion, body, run, copy);
    return picture == "phase" ? phase(motion, body, run, copy) : strip(motion, body, run, copy);
}

json comparison_picture(const Comparison& all, const std::string& motion, const std::string& reference) {
    const double end = drawn_time(all);
    const DistributionDistance& distance =
        all.distributions[static_cast<std::size_t>(Distribution::inclination)].distance;
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
                    {"distance", distance.distance},
                    {"probability", nullptr}};
    if (distance.chance) picture["probability"] = distance.chance->probability;
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
