// The reference falls by other models than samara's: writes their motions, which `samara compare` judges, and
// searches for the coefficients with which a model falls most like the references.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "peers/peer_body.hpp"
#include "samara/analysis/comparison/comparison.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/base/error.hpp"
#include "samara/motion/inclination.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/scene/scene_file.hpp"

#ifdef SAMARA_MUJOCO
#include <mujoco/mujoco.h>

#include "mujoco_body.hpp"
#endif

namespace samara {
namespace {

namespace fs = std::filesystem;

using Coefficients = std::vector<double>;

/// A reference fall and the body that is to fall like it.
struct Fall {
    std::string name;
    std::string shape;
    double step;  // s
    std::shared_ptr<const PeerBody> body;
    Motion reference;
    Measures measures;        // of the reference
    bool judges_inclination;  // false for a sphere
};

struct Request {
    std::string model = "linear-drag";
    std::string falls;
    std::string output;
    std::string coefficients;
    std::string integrator = "implicit";
    int cuts = 1;
    int samples = 0;
};

PeerModel model_of(const Request& request) {
#ifdef SAMARA_MUJOCO
    mju_user_warning = [](const char*) {};  // the rows say which falls broke
    if (request.model == "mujoco") {
        return mujoco_model(request.integrator == "Euler" ? mjINT_EULER
                            : request.integrator == "RK4" ? mjINT_RK4
                                                          : mjINT_IMPLICIT);
    }
#endif
    if (request.model == "paper") return printed_model();
    return request.model == "linear-drag" ? linear_drag_model() : falling_plate_model();
}

/// The falls of a folder: every scene that has its motion beside it, or those named, separated by commas.
std::vector<Fall> read_falls(const std::string& folder_or_names, const PeerModel& model) {
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
        falls.push_back({file.stem().string(), scene.bodies.front().shape.stem().string(), scene.step,
                         model.body(scene, reference), reference,
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

/// The reference with the poses of a fall in place of its own.
Motion motion_of(const Fall& fall, const PeerFall& flown, const Coefficients& coefficients) {
    Motion motion = fall.reference;
    motion.bodies.front().models =
        fmt::format("{}, coefficients {}", fall.body->words(), fmt::join(coefficients, " "));
    motion.bodies.front().poses = flown.poses;
    return motion;
}

/// What a fall misses of its reference, in the limits of `samara compare`; 0 where all its figures are alike.
double misfit(const Fall& fall, const Coefficients& coefficients) {
    const double metrics = fall.judges_inclination ? 4.0 : 1.0;
    const PeerFall flown = fall.body->fall(coefficients, 1);
    if (flown.poses.empty()) return worst_loss * metrics;
    const Motion motion = motion_of(fall, flown, coefficients);
    const Measures a = measure(motion, motion.bodies.front());
    double sum = 0.0;
    for (const Metric metric : compared_metrics) {
        const CataloguedMetric& entry = catalogued(metric);
        if (entry.subject == MetricSubject::inclination && !fall.judges_inclination) continue;
        const auto is = entry.measured(a);
        const auto should = entry.measured(fall.measures);
        if (is && should) sum += loss(*is - *should, usual_tolerances()[metric] * std::abs(*should));
        if (is.has_value() != should.has_value()) sum += worst_loss;
    }
    return sum + (fall.judges_inclination && a.regime != fall.measures.regime ? 1.0 : 0.0);
}

/// A set of coefficients and what each fall misses with it.
struct Trial {
    Coefficients coefficients;
    std::vector<double> misfits;
    [[nodiscard]] double sum() const {
        double all = 0.0;
        for (const double one : misfits) all += one;
        return all;
    }
};

Trial tried(const std::vector<Fall>& falls, const Coefficients& coefficients) {
    Trial trial{coefficients, {}};
    for (const Fall& fall : falls) trial.misfits.push_back(misfit(fall, coefficients));
    return trial;
}

/// Pattern search from `best`: each coefficient up and down, halving the steps where nothing is better. The
/// misfit jumps where a fall changes its regime, so there is no gradient to follow.
Trial refined(const PeerModel& model, const std::vector<Fall>& falls, Trial best) {
    for (double step = 0.08; step > 0.004;) {
        bool better = false;
        for (std::size_t i = 0; i < best.coefficients.size(); ++i) {
            for (const double side : {-1.0, 1.0}) {
                Coefficients next = best.coefficients;
                const PeerCoefficient& range = model.coefficients[i];
                next[i] = std::clamp(next[i] + side * step * (range.highest - range.lowest), range.lowest,
                                     range.highest);
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

/// The model's own coefficients.
Coefficients usual(const PeerModel& model) {
    Coefficients coefficients;
    for (const PeerCoefficient& one : model.coefficients) coefficients.push_back(one.usual);
    return coefficients;
}

/// Coefficients drawn over the whole range, each squared so that small ones are drawn more often; the first
/// are the model's own.
std::vector<Trial> drawn(const PeerModel& model, const std::vector<Fall>& falls, int samples) {
    std::mt19937_64 generator(1);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<Trial> trials = {tried(falls, usual(model))};
    Progress progress("searching", "samples");
    for (int sample = 0; sample < samples; ++sample) {
        Coefficients coefficients;
        for (const PeerCoefficient& one : model.coefficients) {
            coefficients.push_back(one.lowest + std::pow(uniform(generator), 2) * (one.highest - one.lowest));
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
Trial best_of(const PeerModel& model, const std::vector<Fall>& falls, const std::vector<std::size_t>& chosen,
              const std::vector<Trial>& trials, std::size_t starts) {
    std::vector<Fall> some;
    for (const std::size_t i : chosen) some.push_back(falls[i]);
    std::vector<Trial> order = of_falls(trials, chosen);
    std::sort(order.begin(), order.end(), [](const Trial& a, const Trial& b) { return a.sum() < b.sum(); });
    Trial best = order.front();
    for (std::size_t i = 0; i < std::min(starts, order.size()); ++i) {
        const Trial end = refined(model, some, order[i]);
        if (end.sum() < best.sum()) best = end;
    }
    return best;
}

nlohmann::json as_json(const Trial& trial) {
    return {{"coefficients", trial.coefficients}, {"misfit", trial.sum()}};
}

/// The best sets for each fall alone, for each shape, and for all falls. The sets found for few falls are
/// among the starts for many.
nlohmann::json search(const PeerModel& model, const std::vector<Fall>& falls, int samples) {
    std::vector<Trial> trials = drawn(model, falls, samples);
    const double default_misfit = trials.front().sum();
    nlohmann::json alone = nlohmann::json::object();
    std::map<std::string, std::vector<std::size_t>> shapes;
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < falls.size(); ++i) {
        const Trial best = best_of(model, falls, {i}, trials, 1);
        alone[falls[i].name] = as_json(best);
        trials.push_back(tried(falls, best.coefficients));
        shapes[falls[i].shape].push_back(i);
        all.push_back(i);
    }
    nlohmann::json by_shape = nlohmann::json::object();
    for (const auto& [shape, chosen] : shapes) {
        const Trial best = best_of(model, falls, chosen, trials, 3);
        by_shape[shape] = as_json(best);
        for (const std::size_t i : chosen) by_shape[shape]["falls"].push_back(falls[i].name);
        trials.push_back(tried(falls, best.coefficients));
    }
    return {{"samples", samples},
            {"default_misfit", default_misfit},
            {"best", as_json(best_of(model, falls, all, trials, 6))},
            {"best_by_shape", by_shape},
            {"best_alone", alone}};
}

Coefficients coefficients_of(const PeerModel& model, const std::string& words) {
    Coefficients coefficients = usual(model);
    if (words.empty()) return coefficients;
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
            throw Error(fmt::format("--coefficients takes {} numbers, such as {}; it was '{}'",
                                    coefficients.size(), fmt::join(usual(model), ","), words));
        }
    }
    return coefficients;
}

/// Writes FOLDER/NAME.h5 for each fall; a fall whose numbers run away is not written.
nlohmann::json flown(const PeerModel& model, const std::vector<Fall>& falls, const Request& request) {
    const Coefficients coefficients = coefficients_of(model, request.coefficients);
    fs::create_directories(request.output);
    nlohmann::json rows = nlohmann::json::array();
    for (const Fall& fall : falls) {
        PeerFall best = fall.body->fall(coefficients, request.cuts);
        for (int again = 0; again < 4; ++again) {
            best.seconds = std::min(best.seconds, fall.body->fall(coefficients, request.cuts).seconds);
        }
        if (!best.poses.empty()) {
            write_motion_file(fs::path(request.output) / (fall.name + ".h5"),
                              motion_of(fall, best, coefficients));
        }
        rows.push_back(
            {{"fall", fall.name},
             {"broke", best.poses.empty()},
             {"steps", best.steps},
             {"seconds_per_step", best.seconds / best.steps},
             {"seconds_per_simulated_second", best.seconds / (best.steps * fall.step / request.cuts)},
             {"misfit", misfit(fall, coefficients)}});
    }
    return {{"model", model.name}, {"coefficients", coefficients}, {"falls", rows}};
}

nlohmann::json run(const Request& request, const Arguments& arguments) {
    if (request.samples == 0 && request.output.empty()) {
        throw Error("nothing to do: give -o FOLDER to write motions, or --search N");
    }
    const PeerModel model = model_of(request);
    const std::vector<Fall> falls = read_falls(request.falls, model);
    const nlohmann::json result =
        request.samples > 0 ? search(model, falls, request.samples) : flown(model, falls, request);
    if (!arguments.json()) fmt::print("{}\n", result.dump(2));
    return result;
}

}  // namespace
}  // namespace samara

int main(int argc, char** argv) {
    samara::Request request;
    samara::Arguments arguments("samara-peer-falls",
                                "Flies the reference falls by another model than samara's.");
    std::vector<std::string> models = {"paper", "linear-drag", "falling-plate"};
#ifdef SAMARA_MUJOCO
    models.emplace_back("mujoco");
#endif
    arguments.positional("FALLS", request.falls,
                         "folder with scenes (.toml) and their motions by full CFD (.h5), or such scenes, "
                         "separated by commas");
    arguments.choice("--model", request.model, models, "the model");
    arguments.option("-o,--output", request.output, "folder for the model's motions, NAME.h5");
    arguments.option("--coefficients", request.coefficients,
                     "the model's numbers, separated by commas; by default its own");
    arguments.choice("--integrator", request.integrator, {"implicit", "Euler", "RK4"}, "MuJoCo's integrator");
    arguments.option("--cuts", request.cuts, "parts that each step of a scene is cut into", 1, 1000);
    arguments.option("--search", request.samples,
                     "search for the best coefficients instead, from that many drawn ones", 1, 1'000'000);
    return samara::run_program(argc, argv, arguments, [&] { return samara::run(request, arguments); });
}
