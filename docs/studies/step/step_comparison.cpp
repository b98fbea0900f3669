// Error of the trajectory against cost of the step, for five bodies: samara's implicit step, its reference
// integrator, and explicit methods on the same equations. Prints a table, and writes it as a .csv where a
// file is named.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "peers/explicit_steps.hpp"
#include "peers/peer_body.hpp"
#include "support/hard_bodies.hpp"
#include "support/known_bodies.hpp"
#include "support/reference_step.hpp"

namespace samara {
namespace {

constexpr double window = 2.0;  // s: before the tumbling bodies lose their start
const Surroundings surroundings;

struct Row {
    std::string body;
    std::string method;
    double step = 0.0;
    double milliseconds = 0.0;  // of CPU for a simulated second
    double position_error = 0.0;
    double orientation_error = 0.0;
};

/// Where a body is after `steps` steps of the window.
using Simulation = std::function<BodyState(const ImmersedBody&, const BodyState& start, int steps)>;

BodyState implicit_flight(const ImmersedBody& body, const BodyState& start, int steps) {
    const Noise noise(1, "body", 0, 0);
    const double h = window / steps;
    BodyState state = start;
    for (int i = 0; i < steps; ++i) {
        state = advance(body, surroundings, 0.0, h, state, noise, static_cast<std::uint64_t>(i)).state;
    }
    return state;
}

BodyState reference_flight(const ImmersedBody& body, const BodyState& start, int steps) {
    BodyState state = start;
    for (int i = 0; i < steps; ++i) {
        state = reference_step(body, surroundings.gravity, window / steps, state).state;
    }
    return state;
}

using ExplicitStep = MotionVector (*)(const EquationsOfMotion&, double, const MotionVector&);

Simulation explicit_flight(ExplicitStep step) {
    return [step](const ImmersedBody& body, const BodyState& start, int steps) {
        const EquationsOfMotion equations(body, surroundings.gravity, start.sampled_turbulence);
        MotionVector motion = motion_vector(start);
        for (int i = 0; i < steps; ++i) motion = step(equations, window / steps, motion);
        return body_state(motion, start.sampled_turbulence);
    };
}

struct Method {
    const char* name;
    Simulation fly;
};

std::vector<Method> methods() {
    return {{"explicit Euler", explicit_flight(peers::euler_step)},
            {"Runge-Kutta 4", explicit_flight(peers::runge_kutta_step)},
            {"samara implicit", implicit_flight},
            {"samara reference", reference_flight}};
}

/// Thrown askew, with a slow tumble.
BodyState start() {
    return test::tumbling_state(0.2, 5.0);
}

double infinite_unless_number(double value) {
    return std::isfinite(value) ? value : std::numeric_limits<double>::infinity();
}

Row measured(const test::NamedBody& named, const Method& method, int steps, const BodyState& exact,
             double length) {
    Row row{named.name, method.name, window / steps};
    BodyState end;
    row.milliseconds = std::numeric_limits<double>::infinity();
    double spent = 0.0;
    for (int run = 0; run < 200 && (run < 2 || spent < 30.0); ++run) {
        const double begin = cpu_time();
        end = method.fly(named.body, start(), steps);
        const double time = 1e3 * (cpu_time() - begin);  // ms
        row.milliseconds = std::min(row.milliseconds, time / window);
        spent += time;
    }
    row.position_error = infinite_unless_number((end.position - exact.position).norm() / length);
    row.orientation_error = infinite_unless_number(end.orientation.angularDistance(exact.orientation));
    return row;
}

void print(const Row& row) {
    fmt::print("{:<20}{:<18}{:>10.2e}{:>12.4f}{:>12.1e}{:>12.1e}\n", row.body, row.method, row.step,
               row.milliseconds, row.position_error, row.orientation_error);
    std::fflush(stdout);
}

}  // namespace
}  // namespace samara

int main(int argc, char** argv) {
    using namespace samara;
    // From a film frame's step to 1e-5 s.
    constexpr std::array steps_per_second = {24,   48,   100,    240,    500,    1000,
                                             2400, 5000, 10'000, 30'000, 100'000};
    std::vector<Row> rows;
    fmt::print("{:<20}{:<18}{:>10}{:>12}{:>12}{:>12}\n", "body", "method", "step, s", "ms per s", "position",
               "angle, rad");
    for (const test::NamedBody& named : test::five_bodies(Loads::table)) {
        const BodyState exact = reference_flight(named.body, start(), 800'000);
        const BodyState check = reference_flight(named.body, start(), 400'000);
        // What it moves by, or its own size where it hardly moves.
        const double length = std::max(exact.position.norm(), named.body.length);
        fmt::print("{:<20}{:<18}{:>34.1e}{:>12.1e}   moves {:.3f} m\n", named.name, "yardstick's own",
                   (exact.position - check.position).norm() / length,
                   exact.orientation.angularDistance(check.orientation), exact.position.norm());
        for (const Method& method : methods()) {
            for (const int each_second : steps_per_second) {
                const int steps = static_cast<int>(window * each_second);
                rows.push_back(measured(named, method, steps, exact, length));
                print(rows.back());
            }
        }
    }
    if (argc < 2) return 0;
    std::ofstream file(argv[1]);
    file << "body,method,step,milliseconds_per_second,position_error,orientation_error\n";
    for (const Row& row : rows) {
        file << fmt::format("{},{},{:.4e},{:.4e},{:.3e},{:.3e}\n", row.body, row.method, row.step,
                            row.milliseconds, row.position_error, row.orientation_error);
    }
    return file.flush() ? 0 : 1;
}
