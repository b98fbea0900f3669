// How the numbers that loads of the surface share were chosen: searched for on the reference falls, without
// one of the bodies where that is asked, and tried on all. And how far such loads are from tables by CFD.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "converter/falls/fall_record.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/base/parallel_for.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/dynamics/dynamic_coefficients.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/integrator/step.hpp"
#include "samara/kirchhoff/surface_flow.hpp"
#include "samara/motion/measures.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/scene/ready_bodies.hpp"
#include "samara/scene/scene_file.hpp"

namespace samara {
namespace {

// base, separation_sine; transport, spin_lift, drag_in_motion, drag_in_spin, rotational_drag, ..._in_spin
constexpr std::size_t count = 8;
using Numbers = std::array<double, count>;
constexpr Numbers lowest = {-1.5, 0.02, 0.5, -1.0, 0.0, 0.0, 0.0, 0.0};
constexpr Numbers highest = {-0.2, 1.5, 1.5, 3.0, 5.0, 5.0, 4.0, 6.0};
// Where the search begins: a bluff body's base pressure and shared numbers of the order of one.
constexpr Numbers first_guess = {-0.6, 0.3, 0.9, 1.0, 1.0, 0.3, 0.5, 1.0};
constexpr Numbers deviations = {0.15, 0.12, 0.1, 0.5, 0.5, 0.3, 0.3, 0.6};
constexpr int brood = 16;
constexpr int parents = 8;

Numbers chosen() {
    const SurfacePressure pressure;
    const SurfaceMotion motion;
    return {pressure.base,          pressure.separation_sine,      motion.transport,
            motion.spin_lift,       motion.drag_in_motion,         motion.drag_in_spin,
            motion.rotational_drag, motion.rotational_drag_in_spin};
}

struct Fall {
    const char* name;
    const char* body;
    Scene scene = {};
    Motion reference = {};
    Measures measures = {};
    bool judges_inclination = true;
};

class Falls {
  public:
    Falls(const std::string& bodies, int patches) : patches_(patches) {
        for (Fall& fall : falls_) {
            fall.scene = read_scene_file(fmt::format("docs/studies/falls/{}.toml", fall.name));
            fall.reference = read_motion_file(fmt::format("docs/studies/falls/{}.h5", fall.name));
            fall.measures = measure(fall.reference, fall.reference.bodies.front());
            if (bodies_.contains(fall.body)) continue;
            Body body = read_body_file(fmt::format("{}/{}.body.h5", bodies, fall.body));
            body.surface_loads = surface_loads(body.surface, body.moments);
            bodies_.emplace(fall.body, body);
        }
    }

    [[nodiscard]] const std::vector<Fall>& all() const { return falls_; }

    /// The figures of a fall with these numbers.
    [[nodiscard]] Measures flown(const Fall& fall, const Numbers& x) const {
        Body body = bodies_.at(fall.body);
        body.tables =
            as_tables(*body.surface_loads, reference_length(body.moments.surface_area), {x[0], x[1]});
        body.dynamic = IdentifiedCoefficients{
            surface_dynamic_coefficients(body, {x[2], x[3], x[4], x[5], x[6], x[7]}), {}, {}};
        BodyPhysics physics = fall.scene.bodies.front();
        physics.loads = Loads::table;
        physics.turbulence = Turbulence::none;
        physics.patches = patches_;
        const ImmersedBody immersed = make_immersed_body(body, physics, fall.scene.fluid);
        const double step = std::max(fall.scene.step, 0.5 / fall.reference.frame_rate);
        BodyState state;
        state.orientation = fall.scene.bodies.front().orientation;
        std::vector<BodyState> states;
        for (double time = 0.0; time <= fall.reference.times.back(); time += step) {
            states.push_back(state);
            state = implicit_step(immersed, fall.scene.gravity, step, state);
        }
        const Motion motion = motion_of(body, fall.scene.gravity, step, states);
        return measure(motion, motion.bodies.front());
    }

    /// What the numbers miss of the falls of all bodies but one: the mean over the bodies.
    [[nodiscard]] double miss(const Numbers& x, const std::string& without) const {
        std::map<std::string, std::pair<double, int>> of_body;
        for (const Fall& fall : falls_) {
            if (fall.body == without) continue;
            auto& [sum, falls] = of_body[fall.body];
            sum += miss_of(fall, flown(fall, x));
            ++falls;
        }
        double sum = 0.0;
        for (const auto& [name, missed] : of_body) sum += missed.first / missed.second;
        return sum / static_cast<double>(of_body.size());
    }

  private:
    static double square_of(double flown, double solved, double usual) {
        constexpr double most = 6.0;
        const double miss = std::log(std::max(flown, 1e-3 * solved) / solved) / usual;
        return std::min(miss * miss, most * most);
    }

    /// Squared logarithms over 8, 15, 20 and 20 %, in the mean; another regime counts besides.
    static double miss_of(const Fall& fall, const Measures& flown) {
        const Measures& solved = fall.measures;
        double sum = square_of(flown.descent_speed, solved.descent_speed, 0.08);
        if (!fall.judges_inclination) return sum;
        sum += square_of(flown.inclination_amplitude, solved.inclination_amplitude, 0.2);
        sum += square_of(flown.rms_angular_speed, solved.rms_angular_speed, 0.2);
        if (solved.frequency) sum += square_of(flown.frequency.value_or(0.0), *solved.frequency, 0.15);
        if (flown.regime != solved.regime) sum += 16.0;
        return std::min(sum / (solved.frequency ? 4.0 : 3.0), 20.0);
    }

    std::vector<Fall> falls_ = {{"sphere", "sphere", {}, {}, {}, false},
                                {"ellipsoid-tilted", "ellipsoid"},
                                {"ellipsoid-compound", "ellipsoid"},
                                {"ellipsoid-edgewise", "ellipsoid"},
                                {"ellipsoid-heavy", "ellipsoid"},
                                {"spheroid", "spheroid"},
                                {"disc-light", "disc"},
                                {"disc-heavy", "disc"},
                                {"plate", "plate"},
                                {"sheet", "sheet"},
                                {"cube", "cube", {}, {}, {}, false}};
    std::map<std::string, Body> bodies_;
    int patches_;
};

/// A search by broods around a mean that moves, with a spread of its own for each number (Ros and Hansen,
/// A simple modification in CMA-ES, PPSN 2008, without the paths).
Numbers searched(const Falls& falls, const std::string& without, int rounds, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    Numbers mean = first_guess;
    Numbers spread = deviations;
    Numbers best = mean;
    double least = falls.miss(best, without);
    Progress progress("choosing", "rounds");
    for (int round = 0; round < rounds; ++round) {
        std::vector<std::pair<double, Numbers>> tried(brood);
        for (auto& [miss, x] : tried) {
            for (std::size_t i = 0; i < count; ++i) {
                x[i] = std::clamp(mean[i] + spread[i] * normal(random), lowest[i], highest[i]);
            }
        }
        parallel_for(tried.size(), 1, 0, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) tried[i].first = falls.miss(tried[i].second, without);
        });
        std::ranges::sort(tried, {}, [](const auto& one) { return one.first; });
        if (tried.front().first < least) std::tie(least, best) = tried.front();
        for (std::size_t i = 0; i < count; ++i) {
            double center = 0.0;
            double square = 0.0;
            for (int k = 0; k < parents; ++k) {
                const double x = tried[static_cast<std::size_t>(k)].second[i];
                center += x / parents;
                square += (x - mean[i]) * (x - mean[i]) / parents;
            }
            mean[i] = 0.5 * mean[i] + 0.5 * center;
            spread[i] = std::sqrt(0.7 * spread[i] * spread[i] + 0.3 * square);
        }
        progress.update(round + 1, rounds);
    }
    return best;
}

std::string percent(double part, double whole) {
    return fmt::format("{:+.0f} %", 100.0 * (part / whole - 1.0));
}

void print_falls(const Falls& falls, const Numbers& x, const std::string& only) {
    for (const Fall& fall : falls.all()) {
        if (!only.empty() && fall.body != only) continue;
        const Measures flown = falls.flown(fall, x);
        const Measures& solved = fall.measures;
        print_result("| {} | {} | {} | {} | {} | {} / {} |\n", fall.name,
                     percent(flown.descent_speed, solved.descent_speed),
                     flown.frequency && solved.frequency ? percent(*flown.frequency, *solved.frequency) : "-",
                     percent(flown.inclination_amplitude, solved.inclination_amplitude),
                     percent(flown.rms_angular_speed, solved.rms_angular_speed), name_of(flown.regime),
                     name_of(solved.regime));
    }
}

/// The loads of the surface beside a ready-baked body's tables at their highest Reynolds number: the rms of
/// the difference over all directions, over that of the tables.
void print_translations() {
    for (const char* name : {"disc", "ellipsoid", "sheet"}) {
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
        print_result("| {} | {:.0f} % | {:.0f} % |\n", name, 100.0 * std::sqrt(force / all_force),
                     100.0 * std::sqrt(moment / all_moment));
    }
}

struct Request {
    std::string bodies;
    std::string without;
    int rounds = 0;
    int seed = 1;
    int patches = 1;
};

nlohmann::json run(const Request& request) {
    const Falls falls(request.bodies, request.patches);
    const Numbers x = request.rounds > 0 ? searched(falls, request.without, request.rounds,
                                                    static_cast<unsigned>(request.seed))
                                         : chosen();
    const double miss = falls.miss(x, request.without);
    print_result("numbers {:.3g}, miss {:.3g}\n", fmt::join(x, " "), miss);
    print_falls(falls, x, request.without);
    if (request.rounds == 0) print_translations();
    return {{"numbers", x}, {"miss", miss}};
}

}  // namespace
}  // namespace samara

int main(int argc, char** argv) {
    samara::Request request;
    samara::Arguments arguments("samara-surface-choice",
                                "Searches for the numbers that loads of the surface share, on the reference "
                                "falls of docs/studies/falls; from the project's folder.");
    arguments.positional("BODIES", request.bodies, "folder of NAME.body.h5 for the bodies of the falls");
    arguments.option("--rounds", request.rounds, "of the search; 0: the numbers that are in use", 0, 10000);
    arguments.option("--without", request.without, "a body whose falls are left out; they alone are printed");
    arguments.option("--seed", request.seed, "of the search", 1, 1000000);
    arguments.option("--patches", request.patches, "of each body's surface", 1, 32);
    return samara::run_program(argc, argv, arguments, [&] { return samara::run(request); });
}
