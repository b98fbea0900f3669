#include "converter/case_reduction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "converter/foam_dictionary.hpp"
#include "converter/foam_history.hpp"
#include "converter/load_history.hpp"
#include "converter/standard_error.hpp"
#include "samara/base/content_hash.hpp"
#include "samara/base/error.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

/// Fields and history are of the same time of the same run: they differ by the rounding of what was written,
/// six digits or more, alone.
constexpr double largest_disagreement = 1e-4;

/// One case on its way to a sample.
struct CaseSource {
    const fs::path& cases;  ///< the folder of cases
    const CasePlan& plan;
    const PlannedCase& planned;

    [[nodiscard]] fs::path folder() const { return cases / planned.name; }
    [[nodiscard]] Error fault(const std::string& what) const {
        return Error(fmt::format("{}: {}; {}", folder().string(), what,
                                 plan.solved_by_user
                                     ? "solve it again, or take it out of plan.json"
                                     : "remove the folder's provenance.json and run 'samara bake' again"));
    }
};

/// The mean of one quantity over the window.
struct Tail {
    double mean;
    double error;
};

/// The value where it is finite and its time is in the window.
Tail tail_of(const CaseSource& source, const fs::path& file, const std::vector<double>& times,
             const std::vector<double>& values, double start) {
    std::vector<double> window;
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (times[i] < start) continue;
        if (!std::isfinite(values[i])) {
            throw source.fault(fmt::format("diverged: {} holds {} at the time {:.10g}",
                                           file.lexically_relative(source.folder()).string(), values[i],
                                           times[i]));
        }
        window.push_back(values[i]);
    }
    constexpr std::size_t fewest = 4;
    if (window.size() < fewest) {
        throw Error(fmt::format("{}: has {} iterations from {:.10g} on, too few for a mean with an error",
                                file.string(), window.size(), start));
    }
    return {mean(window), standard_error(window)};
}

/// Means in map axes over `unit`.
void reduce_load(const CaseSource& source, const VectorHistory& history, double start, double unit,
                 Vector3d& load, Vector3d& error) {
    const Matrix3d to_map = source.plan.to_map_axes();
    for (int i = 0; i < 3; ++i) {
        std::vector<double> values;
        for (const Vector3d& value : history.values) values.push_back(to_map.row(i).dot(value));
        const Tail tail = tail_of(source, history.file, history.times, values, start);
        load[i] = tail.mean / unit;
        error[i] = tail.error / unit;
    }
}

void require_agreement(const CaseSource& source, const std::string& field, double in_fields,
                       double in_history, double time) {
    if (!(std::abs(in_fields - in_history) <= largest_disagreement * std::abs(in_history))) {
        throw source.fault(fmt::format(
            "the mean {} over the shell at the time {:.10g} is {:.6g} by the fields and {:.6g} by "
            "postProcessing/shell: they are of different runs",
            field, time, in_fields, in_history));
    }
}

/// The row of the history at the time. Throws where it has none.
std::size_t row_at(const CaseSource& source, const FoamHistory& history, const ShellMeans& written) {
    for (std::size_t row = 0; row < history.rows.size(); ++row) {
        if (std::abs(history.rows[row].front() - written.time) <= 1e-6 * written.time) return row;
    }
    throw source.fault(
        fmt::format("the fields were last written at the time {:.10g}, which postProcessing/shell does not "
                    "hold",
                    written.time));
}

fs::path mesh_folder(const CaseSource& source) {
    const fs::path shared = source.cases / source.planned.mesh;
    return fs::exists(shared / "constant" / "polyMesh") ? shared : source.folder();
}

void reduce_turbulence(const CaseSource& source, Shells& shells, double start, DirectionSample& sample) {
    const FoamHistory history =
        read_joined_history(source.folder() / "postProcessing" / "shell", "volFieldValue");
    const ShellMeans written = mean_over_shell(source.folder(), mesh_folder(source), shells);
    const std::size_t last = row_at(source, history, written);
    const std::vector<double> times = history.column("Time", history.rows.front().front());
    const auto reduce = [&](const std::string& field, double in_fields, double unit, double& value,
                            double& error) {
        const std::size_t column = history.index("volAverage(" + field + ")");
        std::vector<double> values;
        for (const std::vector<double>& row : history.rows) values.push_back(row[column]);
        const Tail tail = tail_of(source, history.file, times, values, start);
        require_agreement(source, field, in_fields, values[last], written.time);
        value = tail.mean / unit;
        error = tail.error / unit;
    };
    const auto& [length, speed, density] = source.planned.scales;
    reduce("k", written.turbulent_kinetic_energy, speed * speed, sample.entry.turbulent_kinetic_energy,
           sample.error.turbulent_kinetic_energy);
    reduce("epsilon", written.dissipation_rate, speed * speed * speed / length, sample.entry.dissipation_rate,
           sample.error.dissipation_rate);
}

void require_as_planned(const CaseSource& source) {
    const FoamDictionary parameters(source.folder() / "parameters");
    const PlannedCase& planned = source.planned;
    const Vector3d direction = source.plan.to_map_axes() * parameters.vector("direction");
    const double reynolds_number = parameters.number("reynoldsNumber");
    if (!((direction - planned.direction).norm() < 1e-6)) {
        throw source.fault(
            fmt::format("was solved for the direction ({:.6g}, {:.6g}, {:.6g}), but plan.json has ({:.6g}, "
                        "{:.6g}, {:.6g})",
                        direction.x(), direction.y(), direction.z(), planned.direction.x(),
                        planned.direction.y(), planned.direction.z()));
    }
    if (!(std::abs(reynolds_number - planned.reynolds_number) < 1e-6 * planned.reynolds_number)) {
        throw source.fault(fmt::format("was solved for the Reynolds number {:.6g}, but plan.json has {:.6g}",
                                       reynolds_number, planned.reynolds_number));
    }
}

void require_sane(const CaseSource& source, const DirectionSample& sample, bool laminar) {
    const auto refuse = [&](const std::string& what) { return source.fault("diverged: " + what); };
    const double drag = -sample.entry.force.dot(sample.direction);
    if (!(drag > 0.0)) throw refuse(fmt::format("the drag coefficient is {:.4g}, not positive", drag));
    if (laminar) return;
    if (!(sample.entry.turbulent_kinetic_energy > 0.0)) throw refuse("k in the shell is not positive");
    if (!(sample.entry.dissipation_rate > 0.0)) throw refuse("epsilon in the shell is not positive");
}

nlohmann::json read_provenance(const CaseSource& source) {
    const fs::path file = source.folder() / "provenance.json";
    if (source.plan.solved_by_user && !fs::exists(file)) return {{"solved_by", "user"}};
    nlohmann::json provenance = nlohmann::json::parse(read_bytes(file), nullptr, false);
    if (!provenance.is_object()) {
        throw Error(
            fmt::format("{}: is no JSON object; remove it and run 'samara bake' again", file.string()));
    }
    return provenance;
}

/// The first time that counts for means.
double averaging_start(const CaseSource& source, const nlohmann::json& provenance,
                       const std::vector<double>& times) {
    if (source.planned.averaging_start) return *source.planned.averaging_start;
    if (provenance.contains("averaging_start")) {
        if (provenance["averaging_start"].is_number()) return provenance["averaging_start"].get<double>();
        throw source.fault("'averaging_start' in provenance.json is no number");
    }
    return times[times.size() - (times.size() + 3) / 4];
}

std::string closure_of(const CaseSource& source, const nlohmann::json& provenance) {
    const auto found = provenance.find("closure");
    return found != provenance.end() && found->is_string() ? found->get<std::string>()
                                                           : source.planned.closure;
}

}  // namespace

bool is_solved(const fs::path& folder) {
    return fs::exists(folder / "provenance.json");
}

SolvedCase reduce_case(const fs::path& folder, const CasePlan& plan, const PlannedCase& planned,
                       Shells& shells) {
    const CaseSource source{folder, plan, planned};
    if (!fs::is_directory(source.folder())) throw source.fault("the case's folder is missing");
    const nlohmann::json provenance = read_provenance(source);
    if (!plan.solved_by_user) require_as_planned(source);
    SolvedCase solved{planned.name, planned.reynolds_number, {planned.direction, {}, {}},   provenance.dump(),
                      planned.mesh, planned.purpose,         closure_of(source, provenance)};
    DirectionSample& sample = solved.sample;
    const LoadHistory loads = read_load_history(source.folder() / "postProcessing" / "forces");
    const double start = averaging_start(source, provenance, loads.force.times);
    const auto& [length, speed, density] = planned.scales;
    const double force_unit = std::numbers::pi / 8.0 * density * speed * speed * length * length;
    reduce_load(source, loads.force, start, force_unit, sample.entry.force, sample.error.force);
    reduce_load(source, loads.moment, start, force_unit * length, sample.entry.moment, sample.error.moment);
    const bool laminar = solved.closure == "laminar";
    if (!laminar) reduce_turbulence(source, shells, start, sample);
    require_sane(source, sample, laminar);
    return solved;
}

}  // namespace samara
