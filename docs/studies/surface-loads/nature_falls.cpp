#include "nature_falls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <random>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "converter/falls/fall_record.hpp"
#include "samara/core/base/numbers.hpp"
#include "samara/core/base/parallel_for.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/integrator/step.hpp"
#include "samara/kirchhoff/surface_flow.hpp"
#include "samara/motion/measures.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/scene/scene_file.hpp"

namespace samara {
namespace {

constexpr double gravity = 9.81;
constexpr double most_miss = 25.0;  // of one figure: a fall that is far off counts no more

using Row = std::map<std::string, std::string>;

std::vector<Row> rows_of(const std::string& path) {
    std::ifstream file(path);
    const auto cells_of = [](const std::string& line) {
        std::vector<std::string> cells;
        std::istringstream stream(line);
        for (std::string cell; std::getline(stream, cell, ',');) {
            cell.erase(cell.find_last_not_of("\r ") + 1);
            cells.push_back(cell);
        }
        return cells;
    };
    std::string line;
    std::getline(file, line);
    const std::vector<std::string> heads = cells_of(line);
    std::vector<Row> rows;
    while (std::getline(file, line)) {
        const std::vector<std::string> cells = cells_of(line);
        Row row;
        for (std::size_t i = 0; i < std::min(heads.size(), cells.size()); ++i) row[heads[i]] = cells[i];
        rows.push_back(row);
    }
    return rows;
}

double number(const Row& row, const char* key) {
    return std::stod(row.at(key));
}

bool belongs(std::size_t index, Half half) {
    return half == Half::all || (index % 2 == 0) == (half == Half::fit);
}

double square(double simulated, double measured, double usual) {
    const double miss = std::log(std::max(simulated, 1e-3 * measured) / measured) / usual;
    return std::min(miss * miss, most_miss);
}

double quantile(std::vector<double> values, double share) {
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size()))];
}

double median(const std::vector<double>& values) {
    return quantile(values, 0.5);
}

double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

double spread(const std::vector<double>& values) {
    const double middle = mean(values);
    double sum = 0.0;
    for (const double value : values) sum += (value - middle) * (value - middle);
    return std::sqrt(sum / static_cast<double>(values.size()));
}

Quaterniond tilted(std::mt19937& random, double angle) {
    std::uniform_real_distribution<double> around(0.0, 2.0 * std::numbers::pi);
    const double heading = around(random);
    return Quaterniond(Eigen::AngleAxisd(angle, Vector3d(std::cos(heading), std::sin(heading), 0.0)));
}

/// A body with the tables that the numbers make of it.
Body numbered(Body body, const SharedNumbers& numbers) {
    if (body.tables) return body;
    body.tables = as_tables(*body.surface_loads, reference_length(body.moments.surface_area),
                            numbers.pressure, numbers.wake);
    body.dynamic = IdentifiedCoefficients{surface_dynamic_coefficients(body, numbers.motion), {}, {}};
    return body;
}

ImmersedBody immersed(const Body& body, const MassSpecification& mass, const Fluid& fluid, int patches,
                      bool is_noisy) {
    BodyPhysics physics;
    physics.mass = mass;
    physics.patches = patches;
    physics.turbulence = is_noisy ? Turbulence::table : Turbulence::none;
    return make_immersed_body(body, physics, fluid);
}

Fluid fluid_of(double density, double kinematic_viscosity) {
    Fluid fluid;
    fluid.density = density;
    fluid.viscosity = density * kinematic_viscosity;
    return fluid;
}

/// The states at each step, from rest, until a time (s) or below a height (m).
std::vector<BodyState> states_of(const ImmersedBody& body, const Quaterniond& start, double step,
                                 double duration, double lowest, unsigned copy) {
    const Surroundings surroundings;
    const Noise noise(1, "nature", 0, copy);
    BodyState state;
    state.orientation = start;
    std::vector<BodyState> states;
    for (std::uint64_t i = 0; static_cast<double>(i) * step <= duration; ++i) {
        states.push_back(state);
        if (state.position.z() < lowest) break;
        state = advance(body, surroundings, 0.0, step, state, noise, i).state;
    }
    return states;
}

struct PaperSize {
    std::string body;
    double radius;                         ///< m, of the circumscribed circle
    std::vector<double> descents, drifts;  ///< m/s, degrees: of each drop
};

/// Drops of one shape within 6 mm of radius: level ones, seven at least.
std::vector<PaperSize> paper_sizes(Half half) {
    constexpr double highest_level_release = 1.04;  // m: those above fall already when they are first seen
    constexpr double least = 15.0, width = 6.0;     // mm
    std::map<std::pair<std::string, int>, std::vector<Row>> groups;
    for (const Row& row : rows_of("docs/studies/nature/paper.csv")) {
        if (number(row, "release_m") > highest_level_release) continue;
        groups[{row.at("shape"), static_cast<int>((number(row, "radius_mm") - least) / width)}].push_back(
            row);
    }
    std::vector<PaperSize> sizes;
    for (const auto& [key, drops] : groups) {
        const auto& [shape, bin] = key;
        if (drops.size() < 7 || !belongs(static_cast<std::size_t>(bin), half)) continue;
        std::vector<double> descents, drifts;
        for (const Row& drop : drops) {
            descents.push_back(number(drop, "descent_m_s"));
            drifts.push_back(number(drop, "drift_degrees"));
        }
        sizes.push_back({shape == "circle" ? "thin-disc" : "thin-square",
                         1e-3 * (least + width * (bin + 0.5)), descents, drifts});
    }
    return sizes;
}

/// Mean and standard deviation of the descent, median and 10 to 90 % of the drift.
std::string as_text(const std::vector<double>& descents, const std::vector<double>& drifts) {
    return fmt::format("{:.3f} +- {:.3f} m/s, {:.0f} ({:.0f} to {:.0f}) degrees", mean(descents),
                       spread(descents), median(drifts), quantile(drifts, 0.1), quantile(drifts, 0.9));
}

JudgedFall judged(const PaperSize& size, const Body& body, bool is_noisy) {
    constexpr double grammage = 0.070;  // kg/m^2
    constexpr int copies = 24;
    constexpr double release = 0.05;  // rad, standard deviation
    // The body's circle has 20 mm, the square's side 40 mm: all lengths times `scale`, times its root for
    // times.
    const bool is_disc = size.body == "thin-disc";
    const double scale = (is_disc ? 0.02 : 0.02 * std::numbers::sqrt2) / size.radius;
    const double area = size.radius * size.radius * (is_disc ? std::numbers::pi : 2.0);
    MassSpecification mass;
    mass.mass = grammage * area * scale * scale * scale;
    const ImmersedBody paper =
        immersed(body, mass, fluid_of(1.204, 1.516e-5 * std::pow(scale, 1.5)), 1, is_noisy);
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    std::vector<double> descents, drifts;
    for (unsigned copy = 0; copy < copies; ++copy) {
        const double step = 0.0015 * std::sqrt(scale);
        const auto states = states_of(paper, tilted(random, release * std::abs(normal(random))), step,
                                      6.0 * std::sqrt(scale), -0.98 * scale, copy);
        const auto low = std::ranges::find_if(
            states, [&](const BodyState& state) { return state.position.z() <= -0.43 * scale; });
        const double seconds = step * static_cast<double>(states.end() - 1 - low);
        const Vector3d end = states.back().position;
        descents.push_back(seconds > 0.0 ? (low->position.z() - end.z()) / seconds / std::sqrt(scale) : 0.05);
        drifts.push_back(degrees * std::atan2(std::hypot(end.x(), end.y()), -end.z()));
    }
    return {fmt::format("{}, {:.1f} mm", size.body, 1e3 * size.radius), as_text(descents, drifts),
            as_text(size.descents, size.drifts),
            square(mean(descents), mean(size.descents), 0.07) +
                std::min(16.0, std::pow((median(drifts) - median(size.drifts)) / 8.0, 2))};
}

struct MapDisc {
    double reynolds_number, inertia;
    std::string regime;
};

/// Discs of each regime, drawn evenly, `most` in all.
std::vector<MapDisc> map_discs(Half half, std::size_t most) {
    std::vector<MapDisc> all;
    std::size_t index = 0;
    for (const Row& row : rows_of("docs/studies/discs/field.csv")) {
        if (row.at("regime") == "boundary" || !belongs(++index, half)) continue;
        all.push_back({number(row, "reynolds_number"), number(row, "inertia"),
                       row.at("regime") == "periodic" ? "fluttering" : row.at("regime")});
    }
    std::mt19937 random(3);
    std::ranges::shuffle(all, random);
    std::map<std::string, std::size_t> counts;
    std::erase_if(all, [&](const MapDisc& disc) { return ++counts[disc.regime] > most / 4; });
    return all;
}

JudgedFall judged(const MapDisc& disc, const Body& body, bool is_noisy) {
    constexpr double diameter = 0.04, density = 1000.0;
    constexpr int copies = 3, stride = 2;
    // I* = pi rho t/(64 rho_f d) of the mass rho pi d^2 t/4.
    MassSpecification mass;
    mass.mass = 16.0 * disc.inertia * density * std::pow(diameter, 3);
    const double weight = std::max(*mass.mass - density * body.moments.volume, 0.02 * *mass.mass) * gravity;
    const double guess =
        std::sqrt(weight / (0.5 * density * 1.2 * std::numbers::pi * diameter * diameter / 4.0));
    double speed = guess;
    std::map<std::string, int> regimes;
    for (const bool is_first : {true, false}) {  // the viscosity follows from the mean descent
        const ImmersedBody falling =
            immersed(body, mass, fluid_of(density, speed * diameter / disc.reynolds_number), 1, is_noisy);
        const double unit = diameter / speed;
        std::mt19937 random(11);
        std::uniform_real_distribution<double> angle(0.02, 0.35);
        double descents = 0.0;
        const int falls = is_first ? 1 : copies;
        regimes.clear();
        for (int copy = 0; copy < falls; ++copy) {
            const double step = 0.025 * unit;
            const auto states = states_of(falling, tilted(random, is_first ? 0.15 : angle(random)), step,
                                          (is_first ? 25.0 : 80.0) * unit, -1e9, static_cast<unsigned>(copy));
            std::vector<BodyState> frames;
            for (std::size_t i = 0; i < states.size(); i += stride) frames.push_back(states[i]);
            const Motion motion = motion_of(body, Vector3d(0.0, 0.0, -gravity), stride * step, frames);
            const Measures measures = measure(motion, motion.bodies.front());
            ++regimes[name_of(measures.regime)];
            descents += measures.descent_speed;
        }
        speed = std::max(0.1 * guess, descents / falls);
    }
    std::vector<std::string> found;
    for (const auto& [regime, falls] : regimes) found.push_back(fmt::format("{} {}", falls, regime));
    const int right = regimes[disc.regime];
    return {fmt::format("Re {:.0f}, I* {:.4f}", disc.reynolds_number, disc.inertia),
            fmt::format("{}", fmt::join(found, ", ")), disc.regime, 1.0 - static_cast<double>(right) / copies,
            2 * right > copies};
}

struct CoinDepth {
    double time, mean, deviation;  ///< s, m, m
};
struct Coin {
    std::string name;
    double mass;                    ///< kg
    std::vector<CoinDepth> depths;  ///< the first is that of the release
    double landing;                 ///< m: median distance from the release
};

std::vector<Coin> coins(Half half) {
    std::vector<Coin> all = {{"5-czk", 0.0048, {}, 0.0}, {"50-czk", 0.0097, {}, 0.0}};
    for (Coin& coin : all) {
        for (const Row& row : rows_of("docs/studies/nature/coins.csv")) {
            if (coin.name != row.at("coin")) continue;
            coin.depths.push_back(
                {number(row, "time_s"), 0.01 * number(row, "depth_cm"), 0.01 * number(row, "depth_sd_cm")});
        }
        for (const Row& row : rows_of("docs/studies/nature/coin-landings.csv")) {
            if (coin.name == row.at("coin")) coin.landing = 0.01 * number(row, "median_distance_cm");
        }
    }
    std::vector<Coin> chosen;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (belongs(i, half)) chosen.push_back(all[i]);
    }
    return chosen;
}

/// Depths from the first measured one on, which no fall from rest explains: that is of the release, and so is
/// its scatter.
JudgedFall judged(const Coin& coin, const Body& body, bool is_noisy) {
    constexpr double step = 0.0005, release = 0.04, usual_scatter = 0.4;
    constexpr unsigned copies = 16;
    MassSpecification mass;
    mass.mass = coin.mass;
    const ImmersedBody falling = immersed(body, mass, fluid_of(998.2, 1.004e-6), 1, is_noisy);
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    std::vector<std::vector<BodyState>> falls;
    std::vector<double> landings;
    for (unsigned copy = 0; copy < copies; ++copy) {
        falls.push_back(
            states_of(falling, tilted(random, release * std::abs(normal(random))), step, 1.6, -0.36, copy));
        landings.push_back(falls.back().back().position.head<2>().norm());
    }
    const auto depths_at = [&](double time) {
        std::vector<double> depths;
        for (const auto& states : falls) {
            const auto at = std::min(static_cast<std::size_t>(std::lround(time / step)), states.size() - 1);
            depths.push_back(-states[at].position.z());
        }
        return depths;
    };
    const auto scatter_miss = [](double simulated, double measured) {
        return 0.5 * std::min(9.0, square(simulated, measured, usual_scatter));
    };
    const CoinDepth& first = coin.depths.front();
    const double ahead = first.mean - mean(depths_at(first.time));
    JudgedFall result;
    result.name = fmt::format("coin of {}", coin.name);
    for (std::size_t i = 1; i < coin.depths.size(); ++i) {
        const auto& [time, measured, deviation] = coin.depths[i];
        const std::vector<double> depths = depths_at(time);
        const double own =
            std::sqrt(std::max(1e-6, deviation * deviation - first.deviation * first.deviation));
        result.miss += (square(mean(depths) + ahead, measured, 0.05) + scatter_miss(spread(depths), own)) /
                       static_cast<double>(coin.depths.size() - 1);
        result.simulated +=
            fmt::format("{:.1f} +- {:.1f}, ", 100.0 * (mean(depths) + ahead), 100.0 * spread(depths));
        result.measured += fmt::format("{:.1f} +- {:.1f}, ", 100.0 * measured, 100.0 * own);
    }
    result.miss += scatter_miss(median(landings), coin.landing);
    result.simulated += fmt::format("lands {:.1f} cm aside", 100.0 * median(landings));
    result.measured += fmt::format("lands {:.1f} cm aside", 100.0 * coin.landing);
    return result;
}

struct Fruit {
    std::string name, shape;
    double descent, spin;  ///< m/s, turns/s
    Scene scene;
};

std::vector<Fruit> fruits(const std::string& folder, Half half) {
    std::vector<Fruit> all;
    std::vector<std::string> shapes;
    for (const Row& row : rows_of("docs/studies/nature/fruits.csv")) {
        const std::string radius = row.at("radius") == "10000" ? "straight" : row.at("radius");
        const std::string shape = fmt::format("fruit-{}-{}", row.at("angle"), radius);
        std::string name = fmt::format("{}-{:g}", shape, number(row, "payload"));
        std::ranges::replace(name, '.', '_');
        if (std::ranges::find(shapes, shape) == shapes.end()) shapes.push_back(shape);
        const auto index = static_cast<std::size_t>(std::ranges::find(shapes, shape) - shapes.begin());
        if (!belongs(index, half)) continue;
        all.push_back({name, shape, number(row, "descent"), number(row, "spin"),
                       read_scene_file(fmt::format("{}/{}.toml", folder, name))});
    }
    return all;
}

JudgedFall judged(const Fruit& fruit, const Body& body, bool is_noisy) {
    const SceneBody& given = fruit.scene.bodies.front();
    const ImmersedBody falling = immersed(body, given.mass, fruit.scene.fluid, 8, is_noisy);
    const auto states = states_of(falling, given.orientation, 0.004, 6.0, -1e9, 0);
    double spin = 0.0, descent = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 2 * states.size() / 3; i < states.size(); ++i, ++count) {
        const Matrix3d rotation = states[i].orientation.toRotationMatrix();
        spin += (rotation * states[i].velocity.head<3>()).z();
        descent -= (rotation * states[i].velocity.tail<3>()).z();
    }
    spin = std::abs(spin) / static_cast<double>(count) / (2.0 * std::numbers::pi);
    descent /= static_cast<double>(count);
    const auto text = [](double speed, double rate) {
        return fmt::format("{:.3f} m/s, {:.2f} turns/s", speed, rate);
    };
    constexpr double within = 0.15;
    return {fruit.name, text(descent, spin), text(fruit.descent, fruit.spin),
            square(descent, fruit.descent, 0.1) + square(spin, fruit.spin, 0.15),
            std::abs(descent / fruit.descent - 1.0) < within && std::abs(spin / fruit.spin - 1.0) < within};
}

/// The samara of docs/studies/falls/samara.toml from random attitudes, always: a maple seed spins up and
/// sinks at about 1 m/s.
struct Seed {
    Quaterniond start;
    Scene scene;
};

std::vector<Seed> seeds() {
    const Scene scene = read_scene_file("docs/studies/falls/samara.toml");
    std::mt19937 random(9);
    std::normal_distribution<double> normal;
    std::vector<Seed> all;
    for (int i = 0; i < 10; ++i) {
        const double w = normal(random), x = normal(random), y = normal(random);
        all.push_back({Quaterniond(w, x, y, normal(random)).normalized(), scene});
    }
    return all;
}

JudgedFall judged(const Seed& seed, const Body& body, bool is_noisy) {
    constexpr double step = 0.001, duration = 3.0, descent = 1.0;
    const ImmersedBody falling =
        immersed(body, seed.scene.bodies.front().mass, seed.scene.fluid, 2, is_noisy);
    const Motion motion =
        motion_of(body, seed.scene.gravity, step, states_of(falling, seed.start, step, duration, -1e9, 0));
    const Measures found = measure(motion, motion.bodies.front());
    const bool spins = found.regime == Regime::autorotating;
    return {"samara", fmt::format("{:.2f} m/s, {}", found.descent_speed, name_of(found.regime)),
            "1 m/s, autorotating", spins ? square(found.descent_speed, descent, 0.15) : 10.0, spins};
}

struct ReferenceFall {
    const char* name;
    const char* body;
    bool judges_inclination = true;
    Scene scene = {};
    Motion reference = {};
    Measures measures = {};
};

/// The eleven reference falls by full CFD, always all of them.
std::vector<ReferenceFall> reference_falls() {
    std::vector<ReferenceFall> falls = {{"sphere", "sphere", false},
                                        {"ellipsoid-tilted", "ellipsoid"},
                                        {"ellipsoid-compound", "ellipsoid"},
                                        {"ellipsoid-edgewise", "ellipsoid"},
                                        {"ellipsoid-heavy", "ellipsoid"},
                                        {"spheroid", "spheroid"},
                                        {"disc-light", "disc"},
                                        {"disc-heavy", "disc"},
                                        {"plate", "plate"},
                                        {"sheet", "sheet"},
                                        {"cube", "cube", false}};
    for (ReferenceFall& fall : falls) {
        fall.scene = read_scene_file(fmt::format("docs/studies/falls/{}.toml", fall.name));
        fall.reference = read_motion_file(fmt::format("docs/studies/falls/{}.h5", fall.name));
        fall.measures = measure(fall.reference, fall.reference.bodies.front());
    }
    return falls;
}

/// Squared logarithms over 8, 20, 20 and 15 %, in the mean; another regime counts besides.
JudgedFall judged(const ReferenceFall& fall, const Body& body, bool) {
    const SceneBody& given = fall.scene.bodies.front();
    const ImmersedBody falling = immersed(body, given.mass, fall.scene.fluid, 1, false);
    const double step = std::max(fall.scene.step, 0.5 / fall.reference.frame_rate);
    BodyState state;
    state.orientation = given.orientation;
    std::vector<BodyState> states;
    for (double time = 0.0; time <= fall.reference.times.back(); time += step) {
        states.push_back(state);
        state = implicit_step(falling, fall.scene.gravity, step, state);
    }
    const Motion motion = motion_of(body, fall.scene.gravity, step, states);
    const Measures found = measure(motion, motion.bodies.front());
    const Measures& solved = fall.measures;
    double miss = square(found.descent_speed, solved.descent_speed, 0.08);
    if (fall.judges_inclination) {
        miss += square(found.inclination_amplitude, solved.inclination_amplitude, 0.2);
        miss += square(found.rms_angular_speed, solved.rms_angular_speed, 0.2);
        if (solved.frequency) miss += square(found.frequency.value_or(0.0), *solved.frequency, 0.15);
        if (found.regime != solved.regime) miss += 16.0;
        miss = std::min(miss / (solved.frequency ? 4.0 : 3.0), 20.0);
    }
    const auto text = [](const Measures& measures) {
        return fmt::format("{:.3f} m/s, {:.2f} rad/s, {}", measures.descent_speed, measures.rms_angular_speed,
                           name_of(measures.regime));
    };
    return {fall.name, text(found), text(solved), miss, found.regime == solved.regime};
}

}  // namespace

double JudgedSource::mean_miss() const {
    double sum = 0.0;
    for (const JudgedFall& fall : falls) sum += fall.miss;
    return sum / static_cast<double>(std::max<std::size_t>(1, falls.size()));
}

struct NatureFalls::Data {
    std::vector<PaperSize> paper;
    std::vector<MapDisc> discs;
    std::vector<Coin> coins;
    std::vector<Fruit> fruits;
    std::vector<Seed> seeds;
    std::vector<ReferenceFall> references;
    std::map<std::string, Body> bodies;

    void load(const std::string& folder, const std::string& name) {
        if (bodies.contains(name)) return;
        Body body = read_body_file(fmt::format("{}/{}.body.h5", folder, name));
        body.surface_loads = surface_loads(body.surface, body.moments);
        bodies.emplace(name, std::move(body));
    }
};

NatureFalls::NatureFalls(const std::string& bodies, Half half) {
    auto data = std::make_unique<Data>();
    constexpr std::size_t most_discs = 72;
    data->paper = paper_sizes(half);
    data->discs = map_discs(half, half == Half::all ? 2 * most_discs : most_discs);
    data->coins = coins(half);
    data->fruits = fruits(bodies, half);
    data->seeds = seeds();
    data->references = reference_falls();
    for (const char* name : {"thin-disc", "thin-square"}) data->load(bodies, name);
    for (const Coin& coin : data->coins) data->load(bodies, "coin-" + coin.name);
    for (const Fruit& fruit : data->fruits) data->load(bodies, fruit.shape);
    data->load(bodies, "samara");
    for (const ReferenceFall& fall : data->references) data->load(bodies, fall.body);
    data_ = std::move(data);
}

NatureFalls::~NatureFalls() = default;

std::vector<JudgedSource> NatureFalls::judged(const SharedNumbers& numbers) const {
    std::map<std::string, Body> bodies;
    for (const auto& [name, body] : data_->bodies) bodies.emplace(name, Body());
    std::vector<std::string> names;
    for (const auto& [name, body] : data_->bodies) names.push_back(name);
    const bool is_noisy = numbers.wake.turbulent_kinetic_energy > 0.0;
    const auto for_all = [](std::size_t count, const std::function<void(std::size_t)>& work) {
        parallel_for(count, 1, 0, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) work(i);
        });
    };
    for_all(names.size(),
            [&](std::size_t i) { bodies[names[i]] = numbered(data_->bodies.at(names[i]), numbers); });
    std::vector<JudgedSource> sources;
    const auto judge_all = [&](const char* name, double weight, const auto& falls, const auto& body_of) {
        JudgedSource source{name, weight, std::vector<JudgedFall>(falls.size())};
        for_all(falls.size(), [&](std::size_t i) {
            source.falls[i] = samara::judged(falls[i], bodies.at(body_of(falls[i])), is_noisy);
        });
        sources.push_back(std::move(source));
    };
    judge_all("paper", 2.0, data_->paper, [](const PaperSize& size) { return size.body; });
    judge_all("discs", 40.0, data_->discs, [](const MapDisc&) { return std::string("thin-disc"); });
    judge_all("coins", 1.0, data_->coins, [](const Coin& coin) { return "coin-" + coin.name; });
    judge_all("fruits", 1.5, data_->fruits, [](const Fruit& fruit) { return fruit.shape; });
    judge_all("seeds", 1.0, data_->seeds, [](const Seed&) { return std::string("samara"); });
    judge_all("full CFD", 0.5, data_->references,
              [](const ReferenceFall& fall) { return std::string(fall.body); });
    return sources;
}

}  // namespace samara
