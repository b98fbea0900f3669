#include "converter/tables/fitted_tables.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "converter/tables/direction_sampling.hpp"
#include "samara/analysis/verdicts/case_records.hpp"
#include "samara/core/base/error.hpp"

namespace samara {
namespace {

/// Returns the errors with those of turbulence in_fit_units(), to first order.
LoadEntryError error_in_fit_units(const LoadEntry& entry, const LoadEntryError& error) {
    if (!is_turbulent(entry)) return {error.force, error.moment, 0.0, 0.0};
    return {error.force, error.moment,
            0.5 * error.turbulent_kinetic_energy / std::sqrt(entry.turbulent_kinetic_energy),
            0.5 * error.dissipation_rate / std::sqrt(entry.dissipation_rate)};
}

/// Removes the components that the symmetry forbids from the cases (keep_symmetric_part) and returns the
/// added errors.
std::vector<LoadEntryError> take_forbidden(const Symmetry& symmetry, std::vector<SolvedCase>& cases) {
    std::map<std::pair<CasePurpose, double>, std::vector<std::size_t>> sets;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        sets[{cases[i].purpose, cases[i].reynolds_number}].push_back(i);
    }
    std::vector<LoadEntryError> asymmetry(cases.size());
    for (const auto& [key, members] : sets) {
        std::vector<DirectionSample> samples;
        for (const std::size_t member : members) samples.push_back(cases[member].sample);
        const std::vector<LoadEntryError> taken = keep_symmetric_part(symmetry, samples);
        for (std::size_t i = 0; i < members.size(); ++i) {
            cases[members[i]].sample = samples[i];
            asymmetry[members[i]] = taken[i];
        }
    }
    return asymmetry;
}

/// Returns the cases of one purpose at a Reynolds number; for the purpose `mesh` those on the mesh of the
/// first.
ReynoldsTable table_of(CasePurpose purpose, double reynolds_number, const std::vector<SolvedCase>& cases,
                       const std::vector<LoadEntryError>& tail,
                       const std::vector<LoadEntryError>& asymmetry) {
    ReynoldsTable table;
    table.reynolds_number = reynolds_number;
    std::string mesh;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        if (cases[i].purpose != purpose || cases[i].reynolds_number != reynolds_number) continue;
        if (mesh.empty()) mesh = cases[i].mesh;
        if (purpose == CasePurpose::mesh && cases[i].mesh != mesh) continue;
        table.samples.push_back(cases[i].sample);
        table.tail.push_back(tail[i]);
        table.asymmetry.push_back(asymmetry[i]);
    }
    return table;
}

template <typename Beside>
std::unique_ptr<ReynoldsFit> fit_of(const Symmetry& symmetry, const ReynoldsTable& table, Beside beside) {
    try {
        return std::make_unique<ReynoldsFit>(symmetry, table.samples, std::move(beside));
    } catch (const Error& error) {
        throw Error(fmt::format("Reynolds number {:.6g}: {}", table.reynolds_number, error.what()));
    }
}

const DirectionSample* sample_in(const std::vector<DirectionSample>& samples, const Vector3d& direction,
                                 double tolerance) {
    const auto found = std::ranges::find_if(
        samples, [&](const DirectionSample& one) { return (one.direction - direction).norm() < tolerance; });
    return found == samples.end() ? nullptr : &*found;
}

/// Adds to the cases on the mesh before the last the directions of the table that failed there: the table's
/// value less the change by the last mesh, interpolated from the other directions. Otherwise the error of the
/// interpolation on the mesh before would be taken for a change by the mesh.
void add_failed_directions(const Symmetry& symmetry, const ReynoldsTable& table, ReynoldsTable& before) {
    std::vector<Vector3d> directions;
    std::vector<LoadEntry> changes;
    std::vector<DirectionSample> failed;
    for (const DirectionSample& sample : table.samples) {
        const DirectionSample* const partner =
            sample_in(before.samples, sample.direction, direction_tolerance(symmetry));
        if (partner == nullptr) {
            failed.push_back(sample);
            continue;
        }
        directions.push_back(sample.direction);
        changes.push_back(plus(in_fit_units(sample.entry), -1.0, in_fit_units(partner->entry)));
    }
    if (directions.empty() || failed.empty()) return;
    const DirectionFit change(symmetry, directions);
    for (DirectionSample& sample : failed) {
        const LoadEntry fitted = plus(in_fit_units(sample.entry), -1.0, change.at(changes, sample.direction));
        sample.entry = from_fit_units(fitted, plus({}, 0.5, in_fit_units(sample.entry)));
        before.samples.push_back(sample);
    }
}

}  // namespace

FittedTables fitted_tables(const Symmetry& symmetry, std::vector<SolvedCase>& cases, double main,
                           const std::optional<SurfaceLoads>& surface) {
    std::vector<LoadEntryError> tail;
    tail.reserve(cases.size());
    for (const SolvedCase& solved : cases) {
        tail.push_back(error_in_fit_units(solved.sample.entry, solved.sample.error));
    }
    const std::vector<LoadEntryError> asymmetry = take_forbidden(symmetry, cases);
    std::optional<SurfaceTrend> trend;
    if (surface && symmetry.type == Symmetry::Type::finite) trend.emplace(*surface, symmetry, main);
    ReynoldsTable main_table = table_of(CasePurpose::table, main, cases, tail, asymmetry);
    if (main_table.samples.empty()) throw Error("has no solved case for the tables");
    ReynoldsTable before = table_of(CasePurpose::mesh, main, cases, tail, asymmetry);
    FittedTables result;
    if (before.samples.size() > main_table.samples.size()) {
        add_failed_directions(symmetry, main_table, before);
        result.mesh_before = fit_of(symmetry, before, std::move(trend));
        main_table.fit = fit_of(symmetry, main_table, std::as_const(result.mesh_before).get());
    } else {
        main_table.fit = fit_of(symmetry, main_table, std::move(trend));
    }
    transfer_to_main_mesh(cases, main, *main_table.fit);
    std::set<double> further_reynolds_numbers;
    for (const SolvedCase& solved : cases) {
        if (solved.purpose == CasePurpose::table && solved.reynolds_number != main) {
            further_reynolds_numbers.insert(solved.reynolds_number);
        }
    }
    for (const double reynolds_number : further_reynolds_numbers) {
        ReynoldsTable& table =
            result.tables.emplace_back(table_of(CasePurpose::table, reynolds_number, cases, tail, asymmetry));
        table.fit = fit_of(symmetry, table, std::as_const(main_table.fit).get());
    }
    result.tables.push_back(std::move(main_table));
    std::ranges::sort(result.tables, {}, &ReynoldsTable::reynolds_number);
    return result;
}

namespace {

const SolvedCase* partner(const std::vector<SolvedCase>& cases, const SolvedCase& of, CasePurpose purpose,
                          double reynolds_number) {
    const auto found = std::ranges::find_if(cases, [&](const SolvedCase& one) {
        return one.purpose == purpose && one.reynolds_number == reynolds_number &&
               (one.sample.direction - of.sample.direction).norm() < same_direction;
    });
    return found == cases.end() ? nullptr : &*found;
}

}  // namespace

void transfer_to_main_mesh(std::vector<SolvedCase>& cases, double main, const ReynoldsFit& finest) {
    for (SolvedCase& further : cases) {
        if (further.purpose != CasePurpose::table || further.reynolds_number == main) continue;
        const SolvedCase* const fine = partner(cases, further, CasePurpose::table, main);
        const SolvedCase* const coarse = partner(cases, further, CasePurpose::mesh, main);
        if (coarse == nullptr || coarse->mesh != further.mesh) continue;
        if (fine != nullptr && fine->mesh == further.mesh) continue;
        LoadEntry& entry = further.sample.entry;
        const LoadEntry finer = finest.at(further.sample.direction);
        const LoadEntry& coarser = coarse->sample.entry;
        entry.force += finer.force - coarser.force;
        entry.moment += finer.moment - coarser.moment;
        if (!is_turbulent(entry) || !is_turbulent(finer) || !is_turbulent(coarser)) continue;
        entry.turbulent_kinetic_energy *= finer.turbulent_kinetic_energy / coarser.turbulent_kinetic_energy;
        entry.dissipation_rate *= finer.dissipation_rate / coarser.dissipation_rate;
    }
}

}  // namespace samara
