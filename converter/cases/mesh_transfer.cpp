#include "converter/cases/mesh_transfer.hpp"

#include <algorithm>

#include "samara/analysis/verdicts/case_records.hpp"

namespace samara {
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
