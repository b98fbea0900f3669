// How the numbers that loads of the surface share are chosen: searched for on measured falls and the
// reference falls by full CFD, of half of the bodies of each source, and tried on the other half. And how far
// such loads are from tables by CFD.

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "nature_falls.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/kirchhoff/surface_flow.hpp"
#include "samara/scene/ready_bodies.hpp"

namespace samara {
namespace {

template <auto member>
double& of_motion(SharedNumbers& numbers) {
    return numbers.motion.*member;
}

/// One of the numbers that are searched for, with its range and the usual size of its changes.
struct Searched {
    const char* name;
    double& (*number)(SharedNumbers& numbers);
    double lowest, highest, change;
};
constexpr Searched searched[] = {
    {"transport", of_motion<&SurfaceMotion::transport>, -0.5, 1.5, 0.15},
    {"spin lift", of_motion<&SurfaceMotion::spin_lift>, -1.0, 5.0, 0.5},
    {"spin lift's onset", of_motion<&SurfaceMotion::spin_lift_onset>, 0.0, 5.0, 0.3},
    {"drag in motion", of_motion<&SurfaceMotion::drag_in_motion>, 0.0, 6.0, 0.6},
    {"drag in spin", of_motion<&SurfaceMotion::drag_in_spin>, 0.0, 6.0, 0.4},
    {"rotational drag", of_motion<&SurfaceMotion::rotational_drag>, 0.0, 4.0, 0.2},
    {"its laminar part", of_motion<&SurfaceMotion::laminar_rotational_drag>, 0.0, 20.0, 1.0},
    {"rotational drag in spin", of_motion<&SurfaceMotion::rotational_drag_in_spin>, 0.0, 8.0, 0.6}};
constexpr Eigen::Index count = std::size(searched);

double total(const std::vector<JudgedSource>& sources) {
    double sum = 0.0;
    for (const JudgedSource& source : sources) sum += source.weight * source.mean_miss();
    return sum;
}

/// The numbers at a place in units of their changes, within their ranges; `outside`: how far that was from
/// them.
SharedNumbers numbers_at(const Eigen::VectorXd& place, SharedNumbers numbers, double* outside = nullptr) {
    for (Eigen::Index i = 0; i < count; ++i) {
        const Searched& one = searched[i];
        const double within = std::clamp(place[i] * one.change, one.lowest, one.highest);
        if (outside != nullptr) *outside += std::pow(place[i] - within / one.change, 2);
        one.number(numbers) = within;
    }
    return numbers;
}

/// A search by broods around a mean that moves, whose covariance adapts (CMA-ES; Hansen, arXiv 1604.00772).
/// Falls are chaotic: the last mean is returned, not the luckiest of all that were tried.
SharedNumbers searched_from(const NatureFalls& falls, const SharedNumbers& start, int rounds, unsigned seed) {
    constexpr int brood = 14, parents = 7;
    const auto n = static_cast<double>(count);
    Eigen::VectorXd weights(parents);
    for (int i = 0; i < parents; ++i) weights[i] = std::log(parents + 0.5) - std::log(i + 1.0);
    weights /= weights.sum();
    const double mass = 1.0 / weights.squaredNorm();
    const double path_share = (4.0 + mass / n) / (n + 4.0 + 2.0 * mass / n);
    const double step_share = (mass + 2.0) / (n + mass + 5.0);
    const double rank_one = 2.0 / (std::pow(n + 1.3, 2) + mass);
    const double rank_many =
        std::min(1.0 - rank_one, 2.0 * (mass - 2.0 + 1.0 / mass) / (std::pow(n + 2.0, 2) + mass));
    const double damping = 1.0 + 2.0 * std::max(0.0, std::sqrt((mass - 1.0) / (n + 1.0)) - 1.0) + step_share;
    const double usual_length = std::sqrt(n) * (1.0 - 0.25 / n + 1.0 / (21.0 * n * n));
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    Eigen::VectorXd mean(count);
    SharedNumbers first = start;
    for (Eigen::Index i = 0; i < count; ++i) mean[i] = searched[i].number(first) / searched[i].change;
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(count, count);
    Eigen::VectorXd path = Eigen::VectorXd::Zero(count), step_path = path;
    double spread = 0.7;
    Progress progress("choosing", "rounds");
    for (int round = 0; round < rounds; ++round) {
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(covariance);
        const Eigen::MatrixXd& axes = eigen.eigenvectors();
        const Eigen::VectorXd lengths = eigen.eigenvalues().cwiseMax(1e-12).cwiseSqrt();
        std::vector<std::pair<double, Eigen::VectorXd>> tried;
        for (int k = 0; k < brood; ++k) {
            const Eigen::VectorXd drawn = Eigen::VectorXd::NullaryExpr(count, [&] { return normal(random); });
            const Eigen::VectorXd change = axes * lengths.cwiseProduct(drawn);
            double outside = 0.0;
            const SharedNumbers numbers = numbers_at(mean + spread * change, start, &outside);
            const double miss = total(falls.judged(numbers));
            tried.emplace_back(miss + outside, change);
        }
        std::ranges::sort(tried, {}, [](const auto& one) { return one.first; });
        Eigen::VectorXd move = Eigen::VectorXd::Zero(count);
        Eigen::MatrixXd many = Eigen::MatrixXd::Zero(count, count);
        for (int i = 0; i < parents; ++i) {
            const Eigen::VectorXd& change = tried[static_cast<std::size_t>(i)].second;
            move += weights[i] * change;
            many += weights[i] * change * change.transpose();
        }
        mean += spread * move;
        step_path = (1.0 - step_share) * step_path +
                    std::sqrt(step_share * (2.0 - step_share) * mass) *
                        (axes * lengths.cwiseInverse().cwiseProduct(axes.transpose() * move));
        const double grown = std::sqrt(1.0 - std::pow(1.0 - step_share, 2.0 * (round + 1)));
        const double moves = step_path.norm() / grown / usual_length < 1.4 + 2.0 / (n + 1.0) ? 1.0 : 0.0;
        path = (1.0 - path_share) * path + moves * std::sqrt(path_share * (2.0 - path_share) * mass) * move;
        covariance = (1.0 - rank_one - rank_many) * covariance +
                     rank_one * (path * path.transpose() +
                                 (1.0 - moves) * path_share * (2.0 - path_share) * covariance) +
                     rank_many * many;
        spread =
            std::min(2.0, spread * std::exp(step_share / damping * (step_path.norm() / usual_length - 1.0)));
        progress.update(round + 1, rounds);
    }
    return numbers_at(mean, start);
}

void print_numbers(SharedNumbers numbers) {
    for (const Searched& one : searched) print_result("| {} | {:.3g} |\n", one.name, one.number(numbers));
}

void print_falls(const std::vector<JudgedSource>& sources) {
    for (const JudgedSource& source : sources) {
        print_result("\n{}: mean miss {:.2f}\n", source.name, source.mean_miss());
        for (const JudgedFall& fall : source.falls) {
            print_result("  {:6.2f}  {}: {} (measured: {})\n", fall.miss, fall.name, fall.simulated,
                         fall.measured);
        }
    }
    print_result("\nall {:.2f}\n", total(sources));
}

nlohmann::json as_json(const std::vector<JudgedSource>& sources) {
    nlohmann::json json = nlohmann::json::object();
    for (const JudgedSource& source : sources) {
        for (const JudgedFall& fall : source.falls) {
            json[source.name].push_back({{"name", fall.name},
                                         {"simulated", fall.simulated},
                                         {"measured", fall.measured},
                                         {"miss", fall.miss},
                                         {"holds", fall.holds}});
        }
    }
    return json;
}

/// The loads of the surface beside a ready-baked body's tables at their highest Reynolds number: the rms of
/// the difference over all directions, over that of the tables.
void print_translations() {
    for (const char* name : {"sphere", "disc", "cube", "ellipsoid", "sheet", "leaf", "samara", "airplane"}) {
        const Body body = read_body_file(ready_body_file(name));
        const LoadTables estimated =
            as_tables(surface_loads(body.surface, body.moments), body.tables->reference_length);
        const double reynolds_number = body.tables->reynolds_numbers.back();
        double force = 0.0, moment = 0.0, all_force = 0.0, all_moment = 0.0;
        constexpr int directions = 500;
        for (int i = 0; i < directions; ++i) {
            // Spread evenly over the sphere by the golden angle.
            const double z = 1.0 - (2.0 * i + 1.0) / directions;
            const double angle = 2.399963229728653 * i;
            const double across = std::sqrt(1.0 - z * z);
            const Vector3d direction(across * std::cos(angle), across * std::sin(angle), z);
            const LoadEntry solved = look_up(*body.tables, direction, reynolds_number);
            const LoadEntry found = look_up(estimated, direction, reynolds_number);
            force += (found.force - solved.force).squaredNorm();
            moment += (found.moment - solved.moment).squaredNorm();
            all_force += solved.force.squaredNorm();
            all_moment += solved.moment.squaredNorm();
        }
        print_result("| {} | {:.0f} % | {} |\n", name, 100.0 * std::sqrt(force / all_force),
                     all_moment > 1e-6 * all_force
                         ? fmt::format("{:.0f} %", 100.0 * std::sqrt(moment / all_moment))
                         : "-");
    }
}

struct Request {
    std::string bodies;
    std::string half = "all";
    int rounds = 0;
    int seed = 1;
    double noise = -1.0;
};

nlohmann::json run(const Request& request, const Arguments& arguments) {
    const std::map<std::string, Half> halves = {
        {"fit", Half::fit}, {"choose", Half::choose}, {"all", Half::all}};
    SharedNumbers numbers;
    if (request.noise >= 0.0) numbers.wake.turbulent_kinetic_energy = request.noise;
    const NatureFalls falls(request.bodies, halves.at(request.half));
    if (request.rounds > 0) {
        numbers = searched_from(falls, numbers, request.rounds, static_cast<unsigned>(request.seed));
        if (!arguments.json()) print_numbers(numbers);
    }
    const std::vector<JudgedSource> judged = falls.judged(numbers);
    if (arguments.json()) return as_json(judged);
    print_falls(judged);
    if (request.rounds == 0) print_translations();
    return {};
}

}  // namespace
}  // namespace samara

int main(int argc, char** argv) {
    using namespace samara;
    Request request;
    Arguments arguments("samara-surface-choice",
                        "Judges the numbers that loads of the surface share, or searches for them.");
    arguments.positional("BODIES", request.bodies, "folder of the bodies that fall, with their added mass");
    arguments.choice("--half", request.half, {"fit", "choose", "all"}, "which bodies of each source");
    arguments.option("--rounds", request.rounds, "rounds of a search from the numbers in use; 0: none", 0,
                     10000);
    arguments.option("--seed", request.seed, "of the search", 1, 1000000);
    arguments.option("--noise", request.noise, "k over U^2 of the wake's noise; -1: the one in use", -1.0,
                     1.0);
    return run_program(argc, argv, arguments, [&] { return run(request, arguments); });
}
