#include "converter/case_reduction.hpp"

#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "converter/foam_dictionary.hpp"
#include "converter/foam_file.hpp"
#include "converter/foam_history.hpp"
#include "converter/standard_error.hpp"
#include "samara/base/content_hash.hpp"
#include "samara/base/error.hpp"

namespace samara {
namespace {

/// rho U^2 A / 2 with rho = U = L = 1 and A = pi L^2 / 4.
constexpr double force_unit = std::numbers::pi / 8.0;

/// The two means are over the same iterations of the same run, so that they differ by the rounding of eight
/// digits alone.
constexpr double largest_disagreement = 1e-4;

Error case_fault(const std::filesystem::path& folder, const std::string& what) {
    return Error(fmt::format("{}: {}; remove the folder's provenance.json and run 'samara bake' again",
                             folder.string(), what));
}

/// The averaged tail of one quantity.
struct Tail {
    double mean;
    double error;
};

Tail tail_of(const FoamHistory& history, const std::string& column, double start) {
    const std::vector<double> values = history.column(column, start);
    constexpr std::size_t fewest = 4;
    if (values.size() < fewest) {
        throw Error(fmt::format("{}: has {} iterations from {} on, too few for a mean with an error",
                                history.file.string(), values.size(), start));
    }
    return {mean(values), standard_error(values)};
}

void reduce_load(const std::filesystem::path& file, double start, Vector3d& load, Vector3d& error) {
    const FoamHistory history = read_history(file);
    const char* const columns[] = {"total_x", "total_y", "total_z"};
    for (int i = 0; i < 3; ++i) {
        const Tail tail = tail_of(history, columns[i], start);
        load[i] = tail.mean / force_unit;
        error[i] = tail.error / force_unit;
    }
}

/// The folder of the last written iteration.
std::filesystem::path last_iteration(const std::filesystem::path& folder) {
    std::optional<double> last;
    std::filesystem::path found;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        double iteration = 0.0;
        const auto [end, status] = std::from_chars(name.data(), name.data() + name.size(), iteration);
        if (status != std::errc() || end != name.data() + name.size() || !entry.is_directory()) continue;
        if (last && iteration <= *last) continue;
        last = iteration;
        found = entry.path();
    }
    if (!last || *last == 0.0) throw case_fault(folder, "has no written iteration");
    return found;
}

double volume_mean(const FoamField<double>& field, const FoamField<double>& volumes,
                   const std::vector<std::int64_t>& cells, const std::filesystem::path& file) {
    double sum = 0.0;
    double volume = 0.0;
    for (const std::int64_t cell : cells) {
        const auto index = static_cast<std::size_t>(cell);
        if (cell < 0 || !field.covers(index) || !volumes.covers(index)) {
            throw Error(
                fmt::format("{}: has no value for cell {} of the shell; mesh and field do not belong "
                            "together",
                            file.string(), cell));
        }
        sum += field[index] * volumes[index];
        volume += volumes[index];
    }
    return sum / volume;
}

void require_agreement(const std::filesystem::path& folder, const std::string& field, double in_fields,
                       double in_history) {
    // Written so that values that are not finite pass: the later check says what they are.
    if (std::abs(in_fields - in_history) > largest_disagreement * std::abs(in_history)) {
        throw case_fault(folder,
                         fmt::format("the mean {} over the shell is {:.6g} by the fields and {:.6g} by the "
                                     "iterations: they are of different runs",
                                     field, in_fields, in_history));
    }
}

void reduce_turbulence(const std::filesystem::path& folder, const std::vector<std::int64_t>& shell,
                       double start, DirectionSample& sample) {
    const std::filesystem::path iteration = last_iteration(folder);
    const FoamField<double> volumes = read_scalar_field(iteration / "V");
    const FoamHistory history = read_history(folder / "postProcessing" / "shell" / "0" / "volFieldValue.dat");
    const auto reduce = [&](const std::string& field, double& value, double& error) {
        const std::filesystem::path file = iteration / (field + "Mean");
        value = volume_mean(read_scalar_field(file), volumes, shell, file);
        const Tail tail = tail_of(history, "volAverage(" + field + ")", start);
        require_agreement(folder, field, value, tail.mean);
        error = tail.error;
    };
    reduce("k", sample.entry.turbulent_kinetic_energy, sample.error.turbulent_kinetic_energy);
    reduce("epsilon", sample.entry.dissipation_rate, sample.error.dissipation_rate);
}

void require_as_planned(const std::filesystem::path& folder, const FoamDictionary& parameters,
                        const PlannedCase& planned) {
    const Vector3d direction = parameters.vector("direction");
    const double reynolds_number = parameters.number("reynoldsNumber");
    if (!((direction - planned.direction).norm() < 1e-6)) {
        throw case_fault(folder,
                         fmt::format("was solved for the direction ({:.6g}, {:.6g}, {:.6g}), but plan.json "
                                     "has ({:.6g}, {:.6g}, {:.6g})",
                                     direction.x(), direction.y(), direction.z(), planned.direction.x(),
                                     planned.direction.y(), planned.direction.z()));
    }
    if (!(std::abs(reynolds_number - planned.reynolds_number) < 1e-6 * planned.reynolds_number)) {
        throw case_fault(folder,
                         fmt::format("was solved for the Reynolds number {:.6g}, but plan.json has {:.6g}",
                                     reynolds_number, planned.reynolds_number));
    }
}

void require_sane(const std::filesystem::path& folder, const DirectionSample& sample) {
    const LoadEntry& entry = sample.entry;
    const auto refuse = [&](const std::string& what) { return case_fault(folder, "diverged: " + what); };
    const bool finite =
        entry.force.allFinite() && entry.moment.allFinite() && sample.error.force.allFinite() &&
        sample.error.moment.allFinite() && std::isfinite(entry.turbulent_kinetic_energy) &&
        std::isfinite(entry.dissipation_rate) && std::isfinite(sample.error.turbulent_kinetic_energy) &&
        std::isfinite(sample.error.dissipation_rate);
    if (!finite) throw refuse("its loads or turbulence are not finite");
    const double drag = -entry.force.dot(sample.direction);
    if (!(drag > 0.0)) throw refuse(fmt::format("the drag coefficient is {:.4g}, not positive", drag));
    if (!(entry.turbulent_kinetic_energy > 0.0)) throw refuse("k in the shell is not positive");
    if (!(entry.dissipation_rate > 0.0)) throw refuse("epsilon in the shell is not positive");
}

std::string read_provenance(const std::filesystem::path& file) {
    std::string text = read_bytes(file);
    if (!nlohmann::json::accept(text) || !nlohmann::json::parse(text).is_object()) {
        throw Error(
            fmt::format("{}: is no JSON object; remove it and run 'samara bake' again", file.string()));
    }
    return text;
}

}  // namespace

bool is_solved(const std::filesystem::path& folder) {
    return std::filesystem::exists(folder / "provenance.json");
}

std::vector<std::int64_t> shell_cells(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "constant" / "polyMesh" / "cellZones";
    std::vector<std::int64_t> cells = read_cell_zone(file, "shell");
    if (cells.empty()) {
        throw Error(fmt::format("{}: the zone 'shell' has no cells; the mesh is too coarse", file.string()));
    }
    return cells;
}

SolvedCase reduce_case(const std::filesystem::path& folder, const PlannedCase& planned,
                       const std::vector<std::int64_t>& shell) {
    SolvedCase solved{planned.name,    planned.reynolds_number, {planned.direction, {}, {}}, {}, planned.mesh,
                      planned.purpose, planned.closure};
    solved.provenance = read_provenance(folder / "provenance.json");
    const FoamDictionary parameters(folder / "parameters");
    require_as_planned(folder, parameters, planned);
    const double start = parameters.number("averagingStart");
    DirectionSample& sample = solved.sample;
    const std::filesystem::path forces = folder / "postProcessing" / "forces" / "0";
    reduce_load(forces / "force.dat", start, sample.entry.force, sample.error.force);
    reduce_load(forces / "moment.dat", start, sample.entry.moment, sample.error.moment);
    reduce_turbulence(folder, shell, start, sample);
    require_sane(folder, sample);
    return solved;
}

}  // namespace samara
