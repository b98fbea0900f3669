#include "converter/cases/case_reduction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "converter/cases/case_checks.hpp"
#include "converter/cases/load_fluctuations.hpp"
#include "converter/openfoam/foam_dictionary.hpp"
#include "converter/openfoam/foam_history.hpp"
#include "converter/tables/standard_error.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

/// Fields and history of the same time and run differ only by the rounding of what was written, to six digits
/// or more.
constexpr double largest_disagreement = 1e-4;

/// The difference between means of the same numbers by two programs, one of which wrote all digits.
constexpr double largest_drift = 1e-6;

/// The numbers of a user's plan may be rounded, those of a direction perhaps to a degree.
constexpr double largest_difference = 0.02;

/// The error of sqrt(S/pi) by the body's area S in a mesh, which meshes of few cells do not resolve.
constexpr double largest_difference_of_length = 0.15;

/// A case that is being reduced.
struct CaseSource {
    const fs::path& cases;  ///< the folder of cases
    const CasePlan& plan;
    const PlannedCase& planned;

    [[nodiscard]] fs::path folder() const { return cases / planned.name; }
    [[nodiscard]] std::string remedy() const {
        if (plan.solved_by_user) return "solve it again, or remove it from plan.json";
        return fmt::format("remove the folder {} and run 'samara bake' again", planned.name);
    }
    [[nodiscard]] Error error(const std::string& what) const {
        return Error(fmt::format("{}: {}; {}", folder().string(), what, remedy()));
    }
};

/// The means of one quantity over the averaging window, and their standard errors.
struct Tail {
    Vector3d mean;
    Vector3d error;
};

/// Averages a history from `start` on. Throws where a value in that window is not finite.
Tail tail_of(const CaseSource& source, const QuantityHistory& history, double start) {
    std::array<std::vector<double>, 3> window;
    for (std::size_t i = 0; i < history.times.size(); ++i) {
        if (history.times[i] < start) continue;
        for (int axis = 0; axis < 3; ++axis) {
            const double value = history.values[i][axis];
            if (!std::isfinite(value)) {
                const fs::path& file = history.files.at(history.times[i]);
                throw source.error(fmt::format("diverged: {} holds {} at the time {:.10g}",
                                               file.lexically_relative(source.folder()).string(), value,
                                               history.times[i]));
            }
            window[static_cast<std::size_t>(axis)].push_back(value);
        }
    }
    constexpr std::size_t fewest = 4;
    if (window.front().size() < fewest) {
        throw Error(
            fmt::format("{}: has {} iterations from {:.10g} on, too few for a mean with an error; solve the "
                        "case with more iterations",
                        history.files.at(start).string(), window.front().size(), start));
    }
    return {{mean(window[0]), mean(window[1]), mean(window[2])},
            {tail_error(window[0]), tail_error(window[1]), tail_error(window[2])}};
}

void require_agreement(const CaseSource& source, const std::string& field, double in_fields,
                       double in_history, double time) {
    if (!(std::abs(in_fields - in_history) <= largest_disagreement * std::abs(in_history))) {
        throw source.error(fmt::format(
            "the mean {} over the near wake at the time {:.10g} is {:.6g} in the fields and {:.6g} "
            "in postProcessing: they are from different runs",
            field, time, in_fields, in_history));
    }
}

/// Returns the index of a time in the history. Throws where it is not there.
std::size_t place_of(const CaseSource& source, const QuantityHistory& history, double time) {
    for (std::size_t i = 0; i < history.times.size(); ++i) {
        if (std::abs(history.times[i] - time) <= 1e-6 * time) return i;
    }
    throw source.error(fmt::format(
        "the fields were last written at the time {:.10g}, which is missing in the history of k", time));
}

fs::path mesh_folder(const CaseSource& source) {
    const fs::path shared = source.cases / source.planned.mesh;
    return fs::exists(shared / "constant" / "polyMesh") ? shared : source.folder();
}

// Limits beyond any flow, in units of the coefficients: plates have force coefficients of 2.5, spheres in
// Stokes flow 24/Re; the paper's inflow has k = 1.5 U^2 and epsilon = 1.2 U^3/L, and wakes have a hundredth
// of it.
constexpr double largest_coefficient = 100.0;
constexpr double largest_viscous_coefficient = 1000.0;  // divided by the Reynolds number
constexpr double largest_k = 100.0;
constexpr double largest_epsilon = 1000.0;

/// The units of a case's coefficients, in its own units.
struct CaseUnits {
    double force;
    double moment;
    double k;
    double epsilon;
};

CaseUnits units_of(const CaseScales& scales) {
    const auto& [length, speed, density] = scales;
    const double force = std::numbers::pi / 8.0 * density * speed * speed * length * length;
    return {force, force * length, speed * speed, speed * speed * speed / length};
}

QuantityHistory scalar_history(const FoamHistory& history, std::size_t column, const std::string& name,
                               double largest) {
    QuantityHistory scalar{name, history.files, {}, {}, largest, 0.0, true};
    for (const std::vector<double>& row : history.rows) {
        scalar.times.push_back(row.front());
        scalar.values.emplace_back(row[column], 0.0, 0.0);
    }
    return scalar;
}

/// Converts a history to map axes.
QuantityHistory vector_history(const CaseSource& source, const VectorHistory& history,
                               const std::string& name, double largest) {
    QuantityHistory vectors{name, history.files, history.times, {}, largest};
    const Matrix3d to_map = source.plan.to_map_axes();
    for (const Vector3d& value : history.values) vectors.values.emplace_back(to_map * value);
    return vectors;
}

/// Returns the histories of force, moment and, where the case has its own, k and epsilon.
std::vector<QuantityHistory> histories_of(const CaseSource& source,
                                          const std::optional<TurbulenceHistory>& turbulence) {
    const fs::path folder = source.folder() / "postProcessing";
    const LoadHistory loads = read_load_history(folder / "forces");
    const CaseUnits units = units_of(source.planned.scales);
    const double largest = largest_coefficient + largest_viscous_coefficient / source.planned.reynolds_number;
    std::vector<QuantityHistory> histories = {
        vector_history(source, loads.force, "force", largest * units.force),
        vector_history(source, loads.moment, "moment", largest * units.moment)};
    if (!turbulence) return histories;
    const auto& [mean, zone, field, means, k, epsilon] = *turbulence;
    histories.push_back(scalar_history(means, k, "k", largest_k * units.k));
    histories.push_back(scalar_history(means, epsilon, "epsilon", largest_epsilon * units.epsilon));
    return histories;
}

/// Compares the histories of k and epsilon with the fields that were written last.
void require_fields_agree(const CaseSource& source, const TurbulenceHistory& history,
                          const QuantityHistory& k, const QuantityHistory& epsilon, MeshZones& zones) {
    const WrittenMeans written = written_means(source.folder(), mesh_folder(source), history, zones);
    const std::size_t last = place_of(source, k, written.time);
    require_agreement(source, "k", written.turbulent_kinetic_energy, k.values[last].x(), written.time);
    require_agreement(source, "epsilon", written.dissipation_rate, epsilon.values[last].x(), written.time);
}

/// Throws where the histories end before the fields that were written last.
void require_reach_of_fields(const CaseSource& source, const QuantityHistory& force) {
    const double written = last_written_time(source.folder());
    if (written <= force.times.back() * (1.0 + 1e-6)) return;
    throw source.error(
        fmt::format("the fields were last written at the time {:.10g}, but postProcessing/forces ends at the "
                    "time {:.10g}",
                    written, force.times.back()));
}

/// Returns means and errors of the times from `start` on. Throws where the histories are not whole and
/// plausible.
std::vector<Tail> tails_of(const CaseSource& source, std::vector<QuantityHistory>& histories, double start) {
    require_whole(histories, start, source.remedy());
    std::vector<Tail> tails;
    tails.reserve(histories.size());
    for (const QuantityHistory& history : histories) tails.push_back(tail_of(source, history, start));
    // The moment of a sphere is noise, which scales with the force.
    histories[1].noise = source.planned.scales.length * tails[0].mean.norm();
    for (const QuantityHistory& history : histories) require_plausible(history, start, source.remedy());
    return tails;
}

void require_noted(const CaseSource& source, const std::string& name, const Vector3d& mean,
                   const Vector3d& noted, double noise) {
    if ((mean - noted).norm() <= largest_drift * (noted.norm() + noise)) return;
    throw source.error(
        fmt::format("the mean {} over the averaging window has changed by {:.3g} % since the case was "
                    "solved: the history in postProcessing is damaged",
                    name, 100.0 * (mean - noted).norm() / (noted.norm() + noise)));
}

/// Throws where the means differ from those that provenance.json holds since the case was solved, if it does.
void require_as_noted(const CaseSource& source, const nlohmann::json& provenance,
                      const std::vector<Tail>& tails) {
    const auto vector = [&](const nlohmann::json& numbers) -> Vector3d {
        const auto values = numbers.get<std::array<double, 3>>();
        return source.plan.to_map_axes() * Vector3d(values[0], values[1], values[2]);
    };
    const auto scalar = [](const nlohmann::json& number) { return Vector3d(number.get<double>(), 0.0, 0.0); };
    try {
        if (!provenance.contains("force")) return;
        const Vector3d force = vector(provenance.at("force"));
        require_noted(source, "force", tails[0].mean, force, 0.0);
        require_noted(source, "moment", tails[1].mean, vector(provenance.at("moment")),
                      1e-3 * source.planned.scales.length * force.norm());
        if (tails.size() == 2) return;
        const nlohmann::json* const noted = turbulence_means(provenance);
        if (noted == nullptr) throw source.error("provenance.json holds no means of k and epsilon");
        require_noted(source, "k", tails[2].mean, scalar(noted->at("k")), 0.0);
        require_noted(source, "epsilon", tails[3].mean, scalar(noted->at("epsilon")), 0.0);
    } catch (const nlohmann::json::exception& reason) {
        throw source.error(
            fmt::format("in provenance.json an entry is missing or of the wrong type ({})", reason.what()));
    }
}

void require_as_planned(const CaseSource& source) {
    const FoamDictionary parameters(source.folder() / "parameters");
    const PlannedCase& planned = source.planned;
    const Vector3d direction = source.plan.to_map_axes() * parameters.vector("direction");
    const double reynolds_number = parameters.number("reynoldsNumber");
    if (!((direction - planned.direction).norm() < 1e-6)) {
        throw source.error(
            fmt::format("was solved for the direction ({:.6g}, {:.6g}, {:.6g}), but plan.json has ({:.6g}, "
                        "{:.6g}, {:.6g})",
                        direction.x(), direction.y(), direction.z(), planned.direction.x(),
                        planned.direction.y(), planned.direction.z()));
    }
    if (!(std::abs(reynolds_number - planned.reynolds_number) < 1e-6 * planned.reynolds_number)) {
        throw source.error(fmt::format("was solved for the Reynolds number {:.6g}, but plan.json has {:.6g}",
                                       reynolds_number, planned.reynolds_number));
    }
}

std::string in_words(const Vector3d& vector) {
    return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", vector.x() + 0.0, vector.y() + 0.0, vector.z() + 0.0);
}

/// Throws where a number of the plan differs from that of the case.
void require_near(const CaseSource& source, const std::string& of_case, double found, const char* key,
                  double planned, double tolerance = largest_difference) {
    if (std::abs(found - planned) <= tolerance * planned) return;
    throw Error(fmt::format(
        "{}: {} {:.4g}, but plan.json has the {} {:.4g}; correct the plan, or solve the case for it",
        source.folder().string(), of_case, found, key, planned));
}

void require_flow(const CaseSource& source, const Vector3d& flow) {
    require_near(source, "the speed of the flow far from the body is", flow.norm(), "'speed'",
                 source.planned.scales.speed);
    // In case axes, as in the plan.
    const Vector3d planned = source.plan.to_map_axes().transpose() * source.planned.direction;
    const Vector3d moves = -flow.normalized();
    if ((moves - planned).norm() <= largest_difference) return;
    const bool is_opposite = (moves + planned).norm() <= largest_difference;
    throw Error(
        fmt::format("{}: {} {}, so the body moves along {}, but plan.json has the 'direction' {} of the "
                    "body's velocity; correct it, or solve the case for it",
                    source.folder().string(),
                    is_opposite ? "the flow has the opposite direction: along" : "the flow has the direction",
                    in_words(flow.normalized()), in_words(moves), in_words(planned)));
}

/// Throws where the plan differs from the flow that the case's own files set up, as far as these can be read.
void require_as_set_up(const CaseSource& source, MeshZones& zones) {
    const CaseSetup setup = read_case_setup(source.folder());
    const auto& [length, speed, density] = source.planned.scales;
    if (source.plan.solved_by_user && !setup.patches.empty()) {
        const auto area = zones.area(mesh_folder(source), setup.patches);
        if (area) {
            require_near(source, "sqrt(S/pi) of the body's area S in the mesh is",
                         std::sqrt(*area / std::numbers::pi), "'length'", length,
                         largest_difference_of_length);
        }
    }
    if (setup.flow) require_flow(source, *setup.flow);
    if (setup.density) {
        require_near(source, "the fluid's density (rhoInf of the function object forces) is", *setup.density,
                     "'density'", density);
    }
    if (!setup.viscosity) return;
    require_near(
        source,
        fmt::format(
            "with its viscosity of {:.4g}, the length {:.4g} and the speed {:.4g} the Reynolds number is",
            *setup.viscosity, length, speed),
        speed * length / *setup.viscosity, "'reynolds_number'", source.planned.reynolds_number);
}

void require_sane(const CaseSource& source, const DirectionSample& sample, bool has_turbulence) {
    const auto reject = [&](const std::string& what) { return source.error("diverged: " + what); };
    const double drag = -sample.entry.force.dot(sample.direction);
    if (!(drag > 0.0)) {
        throw reject(fmt::format("the drag coefficient is {:.4g}, not positive{}", drag,
                                 source.plan.solved_by_user
                                     ? ", or 'direction' in plan.json is the direction of the flow, not that "
                                       "of the body's velocity"
                                     : ""));
    }
    if (!has_turbulence) return;
    if (!(sample.entry.turbulent_kinetic_energy > 0.0)) throw reject("the mean of k is not positive");
    if (!(sample.entry.dissipation_rate > 0.0)) throw reject("the mean of epsilon is not positive");
}

nlohmann::json read_provenance(const CaseSource& source) {
    const fs::path file = source.folder() / "provenance.json";
    if (source.plan.solved_by_user && !fs::exists(file)) return {{"solved_by", "user"}};
    nlohmann::json provenance = parse_json_or_discard(read_bytes(file));
    if (!provenance.is_object()) {
        throw Error(
            fmt::format("{}: is not a JSON object; remove it and run 'samara bake' again", file.string()));
    }
    return provenance;
}

/// Returns the first time of the averaging window.
double averaging_start(const CaseSource& source, const nlohmann::json& provenance,
                       const std::vector<double>& times) {
    if (source.planned.averaging_start) return *source.planned.averaging_start;
    if (provenance.contains("averaging_start")) {
        if (provenance["averaging_start"].is_number()) return provenance["averaging_start"].get<double>();
        throw source.error("'averaging_start' in provenance.json is not a number");
    }
    return times[times.size() - (times.size() + 3) / 4];
}

Closure solved_closure(const CaseSource& source, const nlohmann::json& provenance) {
    const auto found = provenance.find("closure");
    return found != provenance.end() && found->is_string() ? closure_of(found->get<std::string>())
                                                           : source.planned.closure;
}

/// Takes k and epsilon from the case that `planned` names, and stores its provenance beside the case's own.
void take_turbulence(const fs::path& folder, const CasePlan& plan, const PlannedCase& planned,
                     MeshZones& zones, SolvedCase& solved) {
    const auto other = std::ranges::find(plan.cases, planned.turbulence_from, &PlannedCase::name);
    if (other == plan.cases.end()) throw std::logic_error("the plan has no case " + planned.turbulence_from);
    const SolvedCase turbulence = reduce_case(folder, plan, *other, zones);
    solved.sample.entry.turbulent_kinetic_energy = turbulence.sample.entry.turbulent_kinetic_energy;
    solved.sample.error.turbulent_kinetic_energy = turbulence.sample.error.turbulent_kinetic_energy;
    solved.sample.entry.dissipation_rate = turbulence.sample.entry.dissipation_rate;
    solved.sample.error.dissipation_rate = turbulence.sample.error.dissipation_rate;
    solved.turbulence_mean = turbulence.turbulence_mean;
    nlohmann::json provenance = parse_json(solved.provenance);
    provenance["turbulence"] = parse_json(turbulence.provenance);
    solved.provenance = provenance.dump();
}

}  // namespace

bool is_solved(const fs::path& folder) {
    return fs::exists(folder / "provenance.json");
}

SolvedCase reduce_case(const fs::path& folder, const CasePlan& plan, const PlannedCase& planned,
                       MeshZones& zones) {
    const CaseSource source{folder, plan, planned};
    if (!fs::is_directory(source.folder())) throw source.error("the case's folder is missing");
    const nlohmann::json provenance = read_provenance(source);
    if (!plan.solved_by_user) require_as_planned(source);
    require_as_set_up(source, zones);
    SolvedCase solved{
        planned.name, planned.reynolds_number, {planned.direction, {}, {}},       provenance.dump(),
        planned.mesh, planned.purpose,         solved_closure(source, provenance)};
    const bool has_turbulence = solved.closure != Closure::laminar && planned.turbulence_from.empty();
    std::optional<TurbulenceHistory> turbulence;
    if (has_turbulence) turbulence = read_turbulence_history(source.folder());
    std::vector<QuantityHistory> histories = histories_of(source, turbulence);
    const double start = averaging_start(source, provenance, histories.front().times);
    const std::vector<Tail> tails = tails_of(source, histories, start);
    require_as_noted(source, provenance, tails);
    DirectionSample& sample = solved.sample;
    const CaseUnits units = units_of(planned.scales);
    sample.entry.force = tails[0].mean / units.force;
    sample.error.force = tails[0].error / units.force;
    sample.entry.moment = tails[1].mean / units.moment;
    sample.error.moment = tails[1].error / units.moment;
    if (!turbulence) {
        require_reach_of_fields(source, histories.front());
    } else {
        require_fields_agree(source, *turbulence, histories[2], histories[3], zones);
        solved.turbulence_mean = turbulence->mean;
        sample.entry.turbulent_kinetic_energy = tails[2].mean.x() / units.k;
        sample.error.turbulent_kinetic_energy = tails[2].error.x() / units.k;
        sample.entry.dissipation_rate = tails[3].mean.x() / units.epsilon;
        sample.error.dissipation_rate = tails[3].error.x() / units.epsilon;
    }
    require_sane(source, sample, has_turbulence);
    if (!planned.turbulence_from.empty()) take_turbulence(folder, plan, planned, zones, solved);
    return solved;
}

}  // namespace samara
