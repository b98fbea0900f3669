// The reference falls in MuJoCo's ellipsoid fluid model: writes its motions, which `samara compare` judges,
// and searches for the coefficients with which it falls most like the references.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "internal/command/arguments.hpp"
#include "internal/command/progress.hpp"
#include "internal/comparison/comparison.hpp"
#include "internal/figures/inclination.hpp"
#include "mujoco_body.hpp"
#include "samara/base/error.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/scene/scene_file.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

constexpr FluidCoefficients lowest = {0.0, 0.0, 0.0, 0.0, 0.0};
constexpr FluidCoefficients highest = {4.0, 12.0, 16.0, 6.0, 6.0};

/// A reference fall and the body that is to fall like it.
struct Fall {
    std::string name;
    std::string shape;
    MujocoBody body;
    Measures measures;        // of the reference
    bool judges_inclination;  // false for a sphere
};

struct Request {
    std::string falls;
    std::string output;
    std::string coefficients;
    std::string integrator = "implicit";
    int cuts = 1;
    int samples = 0;
};

int integrator_of(const std::string& name) {
    return name == "Euler" ? mjINT_EULER : name == "RK4" ? mjINT_RK4 : mjINT_IMPLICIT;
}

/// The falls of a folder: every scene that has its motion beside it, or those named, separated by commas.
std::vector<Fall> read_falls(const std::string& folder_or_names, int integrator) {
    std::vector<fs::path> scenes;
    if (fs::is_directory(folder_or_names)) {
        for (const auto& entry : fs::directory_iterator(folder_or_names)) {
            fs::path motion = entry.path();
            if (motion.extension() != ".toml") continue;
            if (fs::exists(motion.replace_extension(".h5"))) scenes.push_back(entry.path());
        }
    } else {
        std::stringstream words(folder_or_names);
        for (std::string word; std::getline(words, word, ',');) scenes.emplace_back(word);
    }
    std::sort(scenes.begin(), scenes.end());
    std::vector<Fall> falls;
    for (const fs::path& file : scenes) {
        fs::path motion = file;
        const Motion reference = read_motion_file(motion.replace_extension(".h5"));
        const Scene scene = read_scene_file(file);
        falls.push_back({file.stem().string(), scene.bodies.front().shape.stem().string(),
                         MujocoBody(scene, reference, integrator),
                         measure(reference, reference.bodies.front()),
                         has_shortest_axis(reference.bodies.front().surface)});
    }
    if (falls.empty()) throw Error(folder_or_names + ": there is no scene with its motion beside it");
    return falls;
}

/// Cauchy's loss of a difference in its limits: one that is far off counts little more than one that is off.
double loss(double difference, double limit) {
    return std::log1p(std::pow(difference / limit, 2));
}

constexpr double worst_loss = 5.0;  // of a figure that is missing: the loss of 12 limits

/// What a fall misses of its reference, in the limits of `samara compare`; 0 where all its figures are alike.
double misfit(const Fall& fall, const FluidCoefficients& coefficients) {
    const double figures = fall.judges_inclination ? 4.0 : 1.0;
    const MujocoFall flown = fall.body.fall(coefficients);
    if (flown.poses.empty()) return worst_loss * figures;
    const Motion motion = fall.body.motion(flown, coefficients);
    const Measures a = measure(motion, motion.bodies.front());
    double sum = 0.0;
    for (const Figure figure : compared_figures) {
        const CataloguedFigure& entry = catalogued(figure);
        if (entry.subject == FigureSubject::inclination && !fall.judges_inclination) continue;
        const auto is = entry.measured(a);
        const auto should = entry.measured(fall.measures);
        if (is && should) sum += loss(*is - *should, usual_tolerances()[figure] * std::abs(*should));
        if (is.has_value() != should.has_value()) sum += worst_loss;
    }
    return sum + (fall.judges_inclination && a.regime != fall.measures.regime ? 1.0 : 0.0);
}

/// A set of coefficients and what each fall misses with it.
struct Trial {
    FluidCoefficients coefficients{};
    std::vector<double> misfits;
    [[nodiscard]] double sum() const {
        double all = 0.0;
        for (const double one : misfits) all += one;
        return all;
    }
};

Trial tried(const std::vector<Fall>& falls, const FluidCoefficients& coefficients) {
    Trial trial{coefficients, {}};
    for (const Fall& fall : falls) trial.misfits.push_back(misfit(fall, coefficients));
    return trial;
}

/// Pattern search from `best`: each coefficient up and down, halving the steps where nothing is better. The
/// misfit jumps where a fall changes its regime, so there is no gradient to follow.
Trial refined(const std::vector<Fall>& falls, Trial best) {
    for (double step = 0.08; step > 0.004;) {
        bool better = false;
        for (std::size_t i = 0; i < best.coefficients.size(); ++i) {
            for (const double side : {-1.0, 1.0}) {
                FluidCoefficients next = best.coefficients;
                next[i] = std::clamp(next[i] + side * step * (highest[i] - lowest[i]), lowest[i], highest[i]);
                const Trial trial = tried(falls, next);
                if (trial.sum() < best.sum()) {
                    best = trial;
                    better = true;
                }
            }
        }
        if (!better) step *= 0.5;
    }
    return best;
}

/// Coefficients drawn over the whole range, each squared so that small ones are drawn more often; the first
/// are MuJoCo's defaults.
std::vector<Trial> drawn(const std::vector<Fall>& falls, int samples) {
    std::mt19937_64 generator(1);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<Trial> trials = {tried(falls, default_fluid_coefficients)};
    Progress progress("searching", "samples");
    for (int sample = 0; sample < samples; ++sample) {
        FluidCoefficients coefficients{};
        for (std::size_t i = 0; i < coefficients.size(); ++i) {
            coefficients[i] = lowest[i] + std::pow(uniform(generator), 2) * (highest[i] - lowest[i]);
        }
        trials.push_back(tried(falls, coefficients));
        progress.update(sample + 1, samples);
    }
    return trials;
}

/// Those of some falls alone, with their share of a trial's misfits.
std::vector<Trial> of_falls(const std::vector<Trial>& trials, const std::vector<std::size_t>& chosen) {
    std::vector<Trial> parts;
    for (const Trial& trial : trials) {
        parts.push_back({trial.coefficients, {}});
        for (const std::size_t i : chosen) parts.back().misfits.push_back(trial.misfits[i]);
    }
    return parts;
}

/// The best set for some falls: pattern searches from the best of the trials.
Trial best_of(const std::vector<Fall>& falls, const std::vector<std::size_t>& chosen,
              const std::vector<Trial>& trials, std::size_t starts) {
    std::vector<Fall> some;
    for (const std::size_t i : chosen) some.push_back(falls[i]);
    std::vector<Trial> order = of_falls(trials, chosen);
    std::sort(order.begin(), order.end(), [](const Trial& a, const Trial& b) { return a.sum() < b.sum(); });
    Trial best = order.front();
    for (std::size_t i = 0; i < std::min(starts, order.size()); ++i) {
        const Trial end = refined(some, order[i]);
        if (end.sum() < best.sum()) best = end;
    }
    return best;
}

nlohmann::json as_json(const Trial& trial) {
    return {{"coefficients", trial.coefficients}, {"misfit", trial.sum()}};
}

/// The best sets for each fall alone, for each shape, and for all falls. The sets found for few falls are
/// among the starts for many.
nlohmann::json search(const std::vector<Fall>& falls, int samples) {
    std::vector<Trial> trials = drawn(falls, samples);
    const double default_misfit = trials.front().sum();
    nlohmann::json alone = nlohmann::json::object();
    std::map<std::string, std::vector<std::size_t>> shapes;
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < falls.size(); ++i) {
        const Trial best = best_of(falls, {i}, trials, 1);
        alone[falls[i].name] = as_json(best);
        trials.push_back(tried(falls, best.coefficients));
        shapes[falls[i].shape].push_back(i);
        all.push_back(i);
    }
    nlohmann::json by_shape = nlohmann::json::object();
    for (const auto& [shape, chosen] : shapes) {
        const Trial best = best_of(falls, chosen, trials, 3);
        by_shape[shape] = as_json(best);
        for (const std::size_t i : chosen) by_shape[shape]["falls"].push_back(falls[i].name);
        trials.push_back(tried(falls, best.coefficients));
    }
    return {{"samples", samples},
            {"default_misfit", default_misfit},
            {"best", as_json(best_of(falls, all, trials, 6))},
            {"best_by_shape", by_shape},
            {"best_alone", alone}};
}

FluidCoefficients coefficients_of(const std::string& words) {
    if (words.empty()) return default_fluid_coefficients;
    FluidCoefficients coefficients{};
    std::stringstream stream(words);
    for (double& coefficient : coefficients) {
        std::string word;
        std::size_t end = 0;
        if (std::getline(stream, word, ',')) {
            try {
                coefficient = std::stod(word, &end);
            } catch (const std::exception&) {
                end = 0;
            }
        }
        if (end == 0 || end != word.size()) {
            throw Error("--coefficients takes five numbers, such as 0.5,0.25,1.5,1,1; it was '" + words +
                        "'");
        }
    }
    return coefficients;
}

/// Writes FOLDER/NAME.h5 for each fall; a fall whose numbers run away is not written.
nlohmann::json flown(const std::vector<Fall>& falls, const Request& request) {
    const FluidCoefficients coefficients = coefficients_of(request.coefficients);
    fs::create_directories(request.output);
    nlohmann::json rows = nlohmann::json::array();
    for (const Fall& fall : falls) {
        MujocoFall best = fall.body.fall(coefficients, request.cuts);
        for (int again = 0; again < 4; ++again) {
            best.seconds = std::min(best.seconds, fall.body.fall(coefficients, request.cuts).seconds);
        }
        if (!best.poses.empty()) {
            write_motion_file(fs::path(request.output) / (fall.name + ".h5"),
                              fall.body.motion(best, coefficients));
        }
        rows.push_back(
            {{"fall", fall.name},
             {"broke", best.poses.empty()},
             {"steps", best.steps},
             {"seconds_per_step", best.seconds / best.steps},
             {"seconds_per_simulated_second", best.seconds / (best.steps * fall.body.step() / request.cuts)},
             {"misfit", misfit(fall, coefficients)}});
    }
    return {{"coefficients", coefficients}, {"integrator", request.integrator}, {"falls", rows}};
}

nlohmann::json run(const Request& request, const Arguments& arguments) {
    mju_user_warning = [](const char*) {};  // the rows say which falls broke
    if (request.samples == 0 && request.output.empty()) {
        throw Error("nothing to do: give -o FOLDER to write motions, or --search N");
    }
    const std::vector<Fall> falls = read_falls(request.falls, integrator_of(request.integrator));
    const nlohmann::json result =
        request.samples > 0 ? search(falls, request.samples) : flown(falls, request);
    if (!arguments.json()) fmt::print("{}\n", result.dump(2));
    return result;
}

}  // namespace
}  // namespace samara

int main(int argc, char** argv) {
    samara::Request request;
    samara::Arguments arguments("samara-mujoco-falls",
                                "Flies the reference falls with MuJoCo's ellipsoid fluid model.");
    arguments.positional("FALLS", request.falls,
                         "folder with scenes (.toml) and their motions by full CFD (.h5), or such scenes, "
                         "separated by commas");
    arguments.option("-o,--output", request.output, "folder for MuJoCo's motions, NAME.h5");
    arguments.option("--coefficients", request.coefficients,
                     "the five of fluidcoef, separated by commas; by default MuJoCo's own");
    arguments.choice("--integrator", request.integrator, {"implicit", "Euler", "RK4"}, "MuJoCo's integrator");
    arguments.option("--cuts", request.cuts, "parts that each step of a scene is cut into", 1, 1000);
    arguments.option("--search", request.samples,
                     "search for the best coefficients instead, from that many drawn ones", 1, 1'000'000);
    return samara::run_program(argc, argv, arguments, [&] { return samara::run(request, arguments); });
}
