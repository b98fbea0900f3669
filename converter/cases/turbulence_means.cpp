#include "converter/cases/turbulence_means.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "converter/openfoam/foam_dictionary.hpp"
#include "converter/openfoam/foam_file.hpp"
#include "converter/openfoam/foam_history.hpp"
#include "converter/openfoam/foam_scanner.hpp"
#include "converter/openfoam/poly_mesh.hpp"
#include "samara/core/base/error.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

/// Returns the number after "processor" in a folder's name; nothing for other names.
std::optional<int> processor_number(const std::string& name) {
    constexpr std::string_view prefix = "processor";
    if (!name.starts_with(prefix)) return std::nullopt;
    int number = 0;
    const char* const start = name.data() + prefix.size();
    const auto [end, status] = std::from_chars(start, name.data() + name.size(), number);
    const bool whole = status == std::errc() && end == name.data() + name.size();
    return whole ? std::optional(number) : std::nullopt;
}

/// Returns the number of parts into which the case was decomposed; 0 where it is not stated.
int stated_processors(const fs::path& folder) {
    const fs::path file = folder / "system" / "decomposeParDict";
    if (!fs::exists(file)) return 0;
    const FoamDictionary dictionary(file);
    return dictionary.has("numberOfSubdomains") ? static_cast<int>(dictionary.number("numberOfSubdomains"))
                                                : 0;
}

/// Returns the folders processor0, processor1, ...; none where the case is not decomposed.
std::vector<fs::path> processor_folders(const fs::path& folder) {
    int count = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (const auto number = processor_number(entry.path().filename().string())) {
            count = std::max(count, *number + 1);
        }
    }
    if (count > 0) count = std::max(count, stated_processors(folder));
    std::vector<fs::path> processors;
    for (int i = 0; i < count; ++i) {
        processors.push_back(folder / fmt::format("processor{}", i));
        if (!fs::is_directory(processors.back())) {
            throw Error(
                fmt::format("{}: is missing, but the case is decomposed into {} parts; copy all of them, or "
                            "run 'reconstructPar -latestTime' where they are",
                            processors.back().string(), count));
        }
    }
    return processors;
}

/// Whether the case is decomposed in the collated layout: one folder processors2 or several processors4_0-1.
bool is_collated(const fs::path& folder) {
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("processors") && name.size() > 10 && name[10] >= '0' && name[10] <= '9') {
            return true;
        }
    }
    return false;
}

double last_time(const fs::path& folder) {
    const std::vector<TimeFolder> times = time_folders(folder);
    return times.empty() ? 0.0 : times.back().time;
}

/// The fields of a part of the case, and the folder of their mesh.
struct FieldPart {
    fs::path fields;
    fs::path mesh;
};

struct WrittenTime {
    double time = 0.0;
    std::vector<FieldPart> parts;
};

WrittenTime last_written(const fs::path& folder, const fs::path& mesh) {
    WrittenTime written;
    const std::vector<fs::path> processors = processor_folders(folder);
    const double whole = last_time(folder);
    const double cut = processors.empty() ? 0.0 : last_time(processors.front());
    if (whole >= cut && whole > 0.0) {
        return {whole, {{time_folders(folder).back().path, mesh}}};
    }
    for (const fs::path& processor : processors) {
        const std::vector<TimeFolder> times = time_folders(processor);
        if (times.empty() || times.back().time != cut || cut == 0.0) {
            throw Error(
                fmt::format("{}: lacks the time {:.10g}, which processor0 has; let the solver continue",
                            processor.string(), cut));
        }
        written.time = cut;
        written.parts.push_back({times.back().path, processor});
    }
    if (written.parts.empty()) {
        throw Error(
            fmt::format("{}: {}", folder.string(),
                        is_collated(folder)
                            ? "is decomposed in the collated layout; run 'reconstructPar -latestTime' there"
                            : "has no written iteration; let the solver write its last one"));
    }
    return written;
}

/// Returns the field's values in the cells.
std::vector<double> values_at(const FoamField<double>& field, const std::vector<std::int64_t>& cells,
                              const fs::path& file) {
    std::vector<double> values;
    values.reserve(cells.size());
    for (const std::int64_t cell : cells) {
        const auto index = static_cast<std::size_t>(cell);
        if (cell < 0 || !field.covers(index)) {
            throw Error(fmt::format(
                "{}: has no value for cell {} of the near wake; mesh and field do not match; solve "
                "the case again",
                file.string(), cell));
        }
        values.push_back(field[index]);
    }
    return values;
}

/// Throws where a value (k, epsilon or a volume) is negative or not finite.
void require_positive(double value, std::int64_t cell, const fs::path& file) {
    if (value >= 0.0 && std::isfinite(value)) return;
    throw Error(
        fmt::format("{}: is {} in cell {}, which is impossible: diverged or damaged; solve the case again",
                    file.string(), value, cell));
}

/// Returns the volumes of the zone's cells: by the field V, or from the mesh.
std::vector<double> zone_volumes(const fs::path& fields, MeshZone& zone) {
    const fs::path file = fields / "V";
    if (!foam_file_exists(file)) {
        if (foam_file_exists(zone.poly_mesh / "points")) return MeshZones::volumes(zone);
        throw Error(
            fmt::format("{}: is missing, and so is the mesh that would give it; run 'postProcess -func "
                        "writeCellVolumes -latestTime' in the case",
                        file.string()));
    }
    std::vector<double> volumes = values_at(read_scalar_field(file), zone.cells, file);
    for (std::size_t i = 0; i < volumes.size(); ++i) require_positive(volumes[i], zone.cells[i], file);
    return volumes;
}

/// Integrals of the weight (1 or k), and of k and epsilon times it.
struct Sums {
    double weight = 0.0;
    double turbulent_kinetic_energy = 0.0;
    double dissipation_rate = 0.0;
};

void add_part(const FieldPart& part, const TurbulenceHistory& history, MeshZones& zones, Sums& sums) {
    MeshZone& zone = zones.of(part.mesh, history.zone);
    const auto values_of = [&](const std::string& name) {
        const fs::path file = part.fields / name;
        std::vector<double> values = values_at(read_scalar_field(file), zone.cells, file);
        for (std::size_t i = 0; i < values.size(); ++i) require_positive(values[i], zone.cells[i], file);
        return values;
    };
    std::vector<double> weights = zone_volumes(part.fields, zone);
    const std::vector<double> k = values_of("k");
    const std::vector<double> epsilon = values_of(history.dissipation_field);
    for (std::size_t i = 0; i < k.size(); ++i) {
        const double weight = history.mean == TurbulenceMean::near_wake ? k[i] * weights[i] : weights[i];
        sums.weight += weight;
        sums.turbulent_kinetic_energy += weight * k[i];
        sums.dissipation_rate += weight * epsilon[i];
    }
}

}  // namespace

TurbulenceHistory read_turbulence_history(const fs::path& case_folder) {
    const fs::path folder = case_folder / "postProcessing";
    TurbulenceHistory history{TurbulenceMean::near_wake, "nearWake", "epsilon", {}, 0, 0};
    std::string operation = "weightedVolAverage";
    if (!fs::exists(folder / history.zone) && fs::exists(folder / "shell")) {
        history.mean = TurbulenceMean::shell;
        history.zone = "shell";
        operation = "volAverage";
    }
    history.means = read_joined_history(folder / history.zone, "volFieldValue");
    const auto column = [&](const std::string& field) { return fmt::format("{}({})", operation, field); };
    const std::string of_omega = "turbulenceProperties:epsilon";
    if (history.means.has(column(of_omega))) history.dissipation_field = of_omega;
    history.k_column = history.means.index(column("k"));
    history.epsilon_column = history.means.index(column(history.dissipation_field));
    return history;
}

MeshZone& MeshZones::of(const fs::path& folder, const std::string& name) {
    const Zone key(folder, name);
    const auto found = zones_.find(key);
    if (found != zones_.end()) return found->second;
    const fs::path poly_mesh = folder / "constant" / "polyMesh";
    MeshZone zone{poly_mesh, read_cell_zone(poly_mesh / "cellZones", name), {}};
    return zones_.emplace(key, std::move(zone)).first->second;
}

const std::vector<double>& MeshZones::volumes(MeshZone& zone) {
    if (zone.volumes.empty()) zone.volumes = cell_volumes(zone.poly_mesh, zone.cells);
    return zone.volumes;
}

std::optional<double> MeshZones::area(const fs::path& folder, const std::vector<std::string>& patches) {
    const Patches key(folder, patches);
    const auto found = areas_.find(key);
    if (found != areas_.end()) return found->second;
    return areas_.emplace(key, area_of_patches(folder / "constant" / "polyMesh", patches)).first->second;
}

double last_written_time(const fs::path& folder) {
    const std::vector<fs::path> processors = processor_folders(folder);
    return std::max(last_time(folder), processors.empty() ? 0.0 : last_time(processors.front()));
}

WrittenMeans written_means(const fs::path& folder, const fs::path& mesh, const TurbulenceHistory& history,
                           MeshZones& zones) {
    const WrittenTime written = last_written(folder, mesh);
    Sums sums;
    for (const FieldPart& part : written.parts) add_part(part, history, zones, sums);
    if (!(sums.weight > 0.0)) {
        throw Error(fmt::format(
            "{}: the zone '{}' has no cells, or k is 0 in them; use a finer mesh, or solve the case again",
            (written.parts.front().mesh / "constant" / "polyMesh" / "cellZones").string(), history.zone));
    }
    return {written.parts.front().fields, written.time, sums.turbulent_kinetic_energy / sums.weight,
            sums.dissipation_rate / sums.weight};
}

}  // namespace samara
