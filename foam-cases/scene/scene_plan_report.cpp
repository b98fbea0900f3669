#include "foam-cases/scene/scene_plan_report.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "converter/tables/direction_sampling.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

/// Returns the uncertainty of the metrics by the tables as text: "descent speed 3 %, ...".
std::string errors_as_text(const MotionError& error) {
    std::string text;
    for (const Metric metric : baked_metrics) {
        if (!error.metrics[metric]) continue;
        text += fmt::format("{}{} {:.2g} %", text.empty() ? "" : ", ", catalogued(metric).title,
                            100.0 * error.metrics[metric]->of_table);
    }
    return text;
}

nlohmann::json measures_as_json(const PlanRound& round, double tolerance) {
    nlohmann::json json = nlohmann::json::object();
    for (const Metric metric : baked_metrics) {
        const auto& error = round.error.metrics[metric];
        if (!error) continue;
        const CataloguedMetric& entry = catalogued(metric);
        json[entry.key] = {{"value", round.simulation.mean(metric)->value},
                           {"error_of_table", error->of_table},
                           {"error_of_chance", error->of_chance},
                           {"allowed", entry.allowed.share * tolerance}};
    }
    return json;
}

/// Returns the candidate with the image that is nearest to a direction.
std::size_t nearest_candidate(const Vector3d& direction, const std::vector<Vector3d>& candidates,
                              const std::vector<Matrix3d>& elements, const Symmetry& symmetry) {
    const Vector3d axis = symmetry.axes.transpose() * symmetry.axis;
    std::size_t nearest = 0;
    double closest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        for (const Matrix3d& element : elements) {
            const Vector3d image = element * candidates[i];
            const double closeness = symmetry.type == Symmetry::Type::axial
                                         ? -std::abs(image.dot(axis) - direction.dot(axis))
                                         : image.dot(direction);
            // Rounding must not decide between equals.
            if (closeness > closest + 1e-9) {
                closest = closeness;
                nearest = i;
            }
        }
    }
    return nearest;
}

int images_of(const Vector3d& direction, const std::vector<Matrix3d>& elements, double tolerance) {
    std::vector<Vector3d> images;
    for (const Matrix3d& element : elements) {
        const Vector3d image = element * direction;
        const bool known = std::ranges::any_of(
            images, [&](const Vector3d& other) { return (other - image).norm() < tolerance; });
        if (!known) images.push_back(image);
    }
    return static_cast<int>(images.size());
}

}  // namespace

nlohmann::json cost_as_json(const GridCost& cost) {
    return {{"directions", cost.directions},
            {"cases", cost.cases},
            {"estimated_cpu_seconds", std::round(cost.cpu_seconds)}};
}

nlohmann::json scene_plan_as_json(const SceneGoal& goal, const ScenePlan& plan) {
    nlohmann::json json = {{"tolerance", goal.tolerance},
                           {"stopped_because", plan.stopped_because},
                           {"reynolds_numbers", plan.cases.reynolds_numbers()},
                           {"candidate_directions", plan.candidates.directions.size()},
                           {"whole_grid", cost_as_json(whole_grid(plan, false))},
                           {"symmetric_grid", cost_as_json(whole_grid(plan, true))}};
    json["budget"] = goal.budget ? nlohmann::json(*goal.budget) : nlohmann::json();
    json["rounds"] = nlohmann::json::array();
    for (const PlanRound& round : plan.rounds) {
        const RegimeCounts regimes = round.simulation.regimes();
        json["rounds"].push_back({{"directions", round.directions},
                                  {"cases", round.cases},
                                  {"estimated_cpu_seconds", std::round(round.estimated_cpu_seconds)},
                                  {"regime", name_of(regimes.commonest())},
                                  {"regime_share", regimes.share(regimes.commonest())},
                                  {"measures", measures_as_json(round, goal.tolerance)},
                                  {"strayed", round.strayed}});
    }
    return json;
}

std::string round_as_line(const SceneGoal& goal, const ScenePlan& plan) {
    const PlanRound& round = plan.rounds.back();
    const std::string errors = errors_as_text(round.error);
    return fmt::format(
        "round {}: {} directions, {:.0f} CPU s; uncertainty from the tables: {}{}; {}", plan.rounds.size(),
        round.directions, round.cpu_seconds, errors.empty() ? "nothing" : errors,
        round.strayed > 0.0 ? fmt::format("; {:.0f} % of the time outside the plan", 100.0 * round.strayed)
                            : "",
        plan.stopped_because.empty()
            ? fmt::format("continues, as the tolerance of the descent speed is {:.0f} %",
                          100.0 * goal.tolerance)
            : "stops: " + plan.stopped_because);
}

std::string scene_plan_as_text(const SceneGoal& goal, const ScenePlan& plan) {
    std::string text = fmt::format("{:>5} {:>10} {:>6} {:>7} {:>8}  {}\n", "round", "directions", "cases",
                                   "CPU s", "outside", "uncertainty from the tables");
    for (std::size_t i = 0; i < plan.rounds.size(); ++i) {
        const PlanRound& round = plan.rounds[i];
        text +=
            fmt::format("{:>5} {:>10} {:>6} {:>7.0f} {:>6.0f} %  {}\n", i + 1, round.directions, round.cases,
                        round.cpu_seconds, 100.0 * round.strayed, errors_as_text(round.error));
    }
    const GridCost grid = whole_grid(plan, true);
    text += fmt::format(
        "stopped, as {}; tolerance {:.3g} % of the descent speed; the whole grid after symmetry: {} "
        "directions, about {:.0f} CPU s\n",
        plan.stopped_because, 100.0 * goal.tolerance, grid.directions, grid.cpu_seconds);
    return text;
}

std::vector<VisitedDirection> visited_directions(const std::vector<FlowVisit>& visits,
                                                 const Symmetry& symmetry, const ScenePlan& plan) {
    const std::vector<Vector3d>& candidates = plan.candidates.directions;
    const std::vector<Matrix3d> elements = elements_in_map_axes(symmetry);
    std::vector<VisitedDirection> places(candidates.size());
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        places[i].direction = candidates[i];
        places[i].images = images_of(candidates[i], elements, direction_tolerance(symmetry));
        places[i].solved = std::ranges::find(plan.chosen, i) != plan.chosen.end();
    }
    double all = 0.0;
    for (const FlowVisit& visit : visits) {
        VisitedDirection& place = places[nearest_candidate(symmetry.axes.transpose() * visit.direction,
                                                           candidates, elements, symmetry)];
        const bool first = place.share == 0.0;
        place.share += 1.0 / static_cast<double>(visits.size());
        place.load_share += visit.pressure * visit.pressure;
        all += visit.pressure * visit.pressure;
        place.lowest_reynolds_number =
            first ? visit.reynolds_number : std::min(place.lowest_reynolds_number, visit.reynolds_number);
        place.highest_reynolds_number = std::max(place.highest_reynolds_number, visit.reynolds_number);
    }
    for (VisitedDirection& place : places) place.load_share = all > 0.0 ? place.load_share / all : 0.0;
    std::ranges::stable_sort(places, std::greater<>(), &VisitedDirection::share);
    std::erase_if(places, [](const VisitedDirection& place) { return place.share == 0.0 && !place.solved; });
    return places;
}

nlohmann::json plan_picture(const std::string& name, const std::vector<FlowVisit>& visits,
                            const Symmetry& symmetry, const ScenePlan& plan) {
    constexpr std::size_t most_dots = 4000;
    nlohmann::json visited = nlohmann::json::array();
    const std::size_t stride = 1 + visits.size() / most_dots;
    for (std::size_t i = 0; i < visits.size(); i += stride) {
        visited.push_back(as_json(Vector3d(symmetry.axes.transpose() * visits[i].direction)));
    }
    nlohmann::json cases = nlohmann::json::array();
    for (const std::size_t index : plan.chosen) {
        for (const Matrix3d& element : elements_in_map_axes(symmetry)) {
            cases.push_back(as_json(Vector3d(element * plan.candidates.directions[index])));
        }
    }
    return {{"picture", "plan"}, {"name", name}, {"visited", visited}, {"cases", cases}};
}

}  // namespace samara
