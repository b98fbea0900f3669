#include "foam-cases/scene/scene_plan.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "converter/tables/direction_sampling.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/dynamics/loads.hpp"

namespace samara {
namespace {

// Chosen values: further rounds add what the first lacks.
constexpr std::size_t first_directions = 3;  // in addition to the anchors
constexpr std::size_t first_directions_of_arc = 1;
constexpr double far_in_reynolds_number = 2.0;  // beyond this ratio coefficients may differ
constexpr int most_falls_more = 2;              // relative to the goal's number
constexpr std::size_t further_directions = 3;   // number of directions with cases at another Reynolds number

/// Returns the quantile of the visits' Reynolds numbers, weighted by the squared loads there.
double reynolds_quantile(std::vector<FlowVisit> visits, double share) {
    std::ranges::sort(visits, {}, &FlowVisit::reynolds_number);
    double all = 0.0;
    for (const FlowVisit& visit : visits) all += visit.pressure * visit.pressure;
    double sum = 0.0;
    for (const FlowVisit& visit : visits) {
        sum += visit.pressure * visit.pressure;
        if (sum >= share * all) return visit.reynolds_number;
    }
    return visits.back().reynolds_number;
}

double mean_reynolds_number(const std::vector<FlowVisit>& visits) {
    double sum = 0.0;
    double all = 0.0;
    for (const FlowVisit& visit : visits) {
        const double weight = visit.pressure * visit.pressure;
        sum += weight * std::log(visit.reynolds_number);
        all += weight;
    }
    return std::exp(sum / all);
}

/// Returns a relevant Reynolds number far from the main one; 0 where there is none.
double far_reynolds_number(const std::vector<FlowVisit>& visits, double main) {
    const double low = reynolds_quantile(visits, 0.05);
    const double high = reynolds_quantile(visits, 0.95);
    if (main / low > far_in_reynolds_number && main / low >= high / main) {
        return rounded_reynolds_number(low);
    }
    return high / main > far_in_reynolds_number ? rounded_reynolds_number(high) : 0.0;
}

void add_directions(const std::vector<std::size_t>& more, ScenePlan& plan) {
    for (const std::size_t index : more) {
        plan.chosen.push_back(index);
        add_ladder("direction", index, plan.candidates.directions[index], plan.cases.main_reynolds_number,
                   plan.cases);
    }
}

/// Returns those of `count` candidates that are not chosen.
std::vector<std::size_t> without(const std::vector<std::size_t>& chosen, std::size_t count) {
    std::vector<std::size_t> others;
    for (std::size_t index = 0; index < count; ++index) {
        if (std::ranges::find(chosen, index) == chosen.end()) others.push_back(index);
    }
    return others;
}

/// Returns the chosen candidates, first those that lower the uncertainty most.
std::vector<std::size_t> by_weight(const std::vector<WeightedDirection>& weights, const Symmetry& symmetry,
                                   const ScenePlan& plan) {
    std::vector<std::pair<double, std::size_t>> loads;
    for (const std::size_t index : plan.chosen) {
        std::vector<std::size_t> without = plan.chosen;
        std::erase(without, index);
        loads.emplace_back(without.empty()
                               ? 0.0
                               : -mean_squared_spread(symmetry, plan.candidates.directions, without, weights),
                           index);
    }
    std::ranges::stable_sort(loads, {}, &std::pair<double, std::size_t>::first);
    std::vector<std::size_t> order;
    order.reserve(loads.size());
    for (const auto& [load, index] : loads) order.push_back(index);
    return order;
}

/// Adds cases at the Reynolds number in the first `count` of the directions.
void add_reynolds_number(double reynolds_number, std::size_t count, const std::vector<std::size_t>& order,
                         ScenePlan& plan) {
    for (std::size_t i = 0; i < std::min(count, order.size()); ++i) {
        const Vector3d& direction = plan.candidates.directions[order[i]];
        const bool there = std::ranges::any_of(plan.cases.cases, [&](const BakeCase& entry) {
            return entry.direction == direction && entry.reynolds_number == reynolds_number;
        });
        if (!there) add_further_reynolds_number(direction, reynolds_number, plan.cases);
    }
}

double share_strayed(const std::vector<FlowVisit>& visits, const ScenePlan& plan) {
    const auto strayed = std::ranges::count_if(visits, [&](const FlowVisit& visit) {
        return !plan.region.holds(plan.cases.axes.transpose() * visit.direction);
    });
    return visits.empty() ? 0.0 : static_cast<double>(strayed) / static_cast<double>(visits.size());
}

UncertainTables uncertain_tables(const Conversion& conversion, const ScenePlan& plan) {
    UncertainTables uncertain;
    uncertain.sampling_errors = conversion.sampling_errors;
    uncertain.reynolds_number = plan.cases.main_reynolds_number;
    const std::vector<Vector3d>& candidates = plan.candidates.directions;
    for (const std::size_t index : plan.chosen) uncertain.solved.push_back(candidates[index]);
    for (const std::size_t index : without(plan.chosen, candidates.size())) {
        uncertain.unsolved.push_back(candidates[index]);
    }
    return uncertain;
}

/// Returns the rms change of the force coefficient from the main Reynolds number to those of the visits,
/// relative to the force: the error of a table without them.
double change_with_reynolds_number(const LoadTables& tables, const std::vector<FlowVisit>& visits,
                                   double main) {
    double sum = 0.0;
    double all = 0.0;
    for (const FlowVisit& visit : visits) {
        const double weight = visit.pressure * visit.pressure;
        const Vector3d here = look_up(tables, visit.direction, visit.reynolds_number).force;
        const Vector3d there = look_up(tables, visit.direction, main).force;
        sum += weight * (here - there).squaredNorm();
        all += weight * there.squaredNorm();
    }
    return all > 0.0 ? std::sqrt(sum / all) : 0.0;
}

bool adds_reynolds_numbers(const SceneGoal& goal, const LoadTables& tables, const Symmetry& symmetry,
                           const std::vector<FlowVisit>& visits, ScenePlan& plan) {
    const std::vector<double>& further = plan.cases.further_reynolds_numbers;
    if (further.empty() || plan.reynolds_collapsed) return false;
    if (change_with_reynolds_number(tables, visits, plan.cases.main_reynolds_number) < goal.tolerance) {
        plan.reynolds_collapsed = true;
        return false;
    }
    const std::size_t before = plan.cases.cases.size();
    const std::vector<std::size_t> order = by_weight(direction_weights(visits, symmetry), symmetry, plan);
    add_reynolds_number(further.front(), further_directions, order, plan);
    return plan.cases.cases.size() > before;
}

/// Returns the number of directions that the next round adds: a sixth of those solved, up to half where the
/// error is far beyond the tolerance; at least two.
std::size_t next_count(const ScenePlan& plan, const Symmetry& symmetry, double worst) {
    if (symmetry.type == Symmetry::Type::axial) return 1;
    const double share = std::clamp(worst, 1.0, 3.0) / 6.0;
    return std::max<std::size_t>(
        2, static_cast<std::size_t>(std::floor(share * static_cast<double>(plan.chosen.size()))));
}

/// Raises the error by the tables to what the metrics changed by since the round before, beyond chance: drawn
/// tables do not show a regime that only directions not solved yet would bring about.
void include_change(const PlanRound& before, PlanRound& round) {
    for (const Metric metric : baked_metrics) {
        auto& error = round.error.metrics[metric];
        if (!error) continue;
        const auto now = round.simulation.mean(metric);
        const auto then = before.simulation.mean(metric);
        if (!then) {
            error->of_table = std::max(error->of_table, 1.0);
            continue;
        }
        const double change = now->value - then->value;
        const double chance = std::hypot(now->error.value_or(0.0), then->error.value_or(0.0));
        const double beyond = std::sqrt(std::max(change * change - 4.0 * chance * chance, 0.0));
        error->of_table = std::max(error->of_table, beyond / std::abs(now->value));
    }
}

/// Throws Error where the body has no load within the scene, which then determines no cases.
void require_loads(const SceneGoal& goal, const SampledFalls& simulation) {
    const Scene& scene = goal.scene;
    const SceneBody& body = scene.bodies[goal.body];
    const double mean = mean_reynolds_number(simulation.visits);
    if (scene.step <= scene.duration - body.start && mean > 0.0 && std::isfinite(mean)) return;
    throw Error(
        fmt::format("{}: the body '{}' does not move in the scene, so no cases can be planned for it: it "
                    "starts at {:.6g} s, and the scene ends at {:.6g} s, in steps of {:.6g} s; give a longer "
                    "duration or a shorter step",
                    scene.file.string(), body.name, body.start, scene.duration, scene.step));
}

}  // namespace

ScenePlan first_plan(const SceneGoal& goal, const Body& body, const BakeQuality& quality,
                     const Inflow& inflow, const SampledFalls& simulation) {
    require_loads(goal, simulation);
    const Symmetry& symmetry = body.symmetry;
    ScenePlan plan;
    plan.candidates = candidate_directions(symmetry);
    plan.cases = plan_of_meshes(body, quality);
    plan.cases.inflow = inflow;
    plan.cases.covers_scene = true;
    plan.cases.subdivisions = stored_subdivisions(plan.candidates, quality);
    plan.cases.main_reynolds_number = rounded_reynolds_number(mean_reynolds_number(simulation.visits));
    plan.region = visited_region(simulation.visits, symmetry);
    add_directions(ends_of_axes(symmetry, plan.candidates.directions), plan);
    const std::size_t few =
        symmetry.type == Symmetry::Type::axial ? first_directions_of_arc : first_directions;
    add_directions(goal.whole_grid ? without(plan.chosen, plan.candidates.directions.size())
                                   : choose_directions(symmetry, plan.candidates.directions, plan.chosen,
                                                       direction_weights(simulation.visits, symmetry), few),
                   plan);
    const std::vector<std::size_t> order =
        by_weight(direction_weights(simulation.visits, symmetry), symmetry, plan);
    if (const double far = far_reynolds_number(simulation.visits, plan.cases.main_reynolds_number);
        far > 0.0) {
        add_reynolds_number(far, 1, order, plan);
    }
    for (std::size_t i = 0; i < std::min(further_directions, order.size()); ++i) {
        add_other_closures(plan.candidates.directions[order[i]], plan.cases);
    }
    estimate_cost(plan.cases);
    return plan;
}

void judge_round(const SceneGoal& goal, const Conversion& conversion, double cpu_seconds, ScenePlan& plan) {
    const Symmetry& symmetry = conversion.body.symmetry;
    PlanRound round;
    round.directions = plan.chosen.size();
    round.cases = plan.cases.cases.size();
    round.estimated_cpu_seconds = plan.cases.cpu_seconds;
    round.cpu_seconds = cpu_seconds;
    const UncertainTables uncertain = uncertain_tables(conversion, plan);
    // Where falls differ much, more of them are needed to estimate the uncertainty by the tables.
    for (int falls = goal.falls; falls <= most_falls_more * goal.falls; falls *= 2) {
        round.simulation = simulate_for_bake(goal.scene, goal.body, conversion.body, falls);
        round.error = motion_error(goal.scene, goal.body, conversion.body, uncertain, round.simulation, falls,
                                   goal.draws);
        if (round.error.worst_chance(goal.tolerance) <= 0.5) break;
    }
    if (!plan.rounds.empty()) include_change(plan.rounds.back(), round);
    round.strayed = share_strayed(round.simulation.visits, plan);
    const std::vector<FlowVisit> visits = std::move(round.simulation.visits);
    round.simulation.visits = {};
    const double worst = round.error.worst(goal.tolerance);
    // One round shows no change: only one that solves all directions is enough.
    const bool good = worst <= 1.0 && (!plan.rounds.empty() || uncertain.unsolved.empty());
    plan.rounds.push_back(round);
    // Directions outside the plan are judged with the rest, and planned from now on.
    if (symmetry.type != Symmetry::Type::spherical) merge(plan.region, visited_region(visits, symmetry));
    if (plan.rounds.size() >= static_cast<std::size_t>(goal.most_rounds)) {
        plan.stopped_because = fmt::format("the limit of {} rounds is reached", goal.most_rounds);
    }

    ScenePlan next = plan;
    const bool more_reynolds_numbers =
        adds_reynolds_numbers(goal, *conversion.body.tables, symmetry, visits, next);
    plan.reynolds_collapsed = next.reynolds_collapsed;
    if (good && !more_reynolds_numbers) {
        plan.stopped_because = "the tolerance is met";
    } else if (next.chosen.size() == next.candidates.directions.size() && !more_reynolds_numbers) {
        plan.stopped_because = "every direction is solved";
    }
    if (!plan.stopped_because.empty()) return;
    if (!good) {
        add_directions(
            choose_directions(symmetry, next.candidates.directions, next.chosen,
                              direction_weights(visits, symmetry), next_count(next, symmetry, worst)),
            next);
    }
    estimate_cost(next.cases);
    if (goal.budget && next.cases.cpu_seconds > *goal.budget) {
        plan.stopped_because =
            fmt::format("the next round would take {:.0f} CPU seconds in total, beyond the budget",
                        next.cases.cpu_seconds);
        return;
    }
    plan = std::move(next);
}

GridCost whole_grid(const ScenePlan& plan, bool with_symmetry) {
    const int n = plan.candidates.subdivisions;
    GridCost cost;
    cost.directions =
        with_symmetry ? plan.candidates.directions.size() : static_cast<std::size_t>(4 * n * n + 2);
    BakePlan grid = plan.cases;
    grid.cases.clear();
    for (std::size_t i = 0; i < cost.directions; ++i) {
        add_ladder("direction", i, Vector3d::UnitX(), grid.main_reynolds_number, grid);
    }
    estimate_cost(grid);
    cost.cases = grid.cases.size();
    cost.cpu_seconds = grid.cpu_seconds;
    return cost;
}

}  // namespace samara
