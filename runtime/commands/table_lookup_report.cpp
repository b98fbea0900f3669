#include "samara/commands/table_lookup_report.hpp"

#include <nlohmann/json.hpp>

#include "samara/commands/shared/print.hpp"
#include "samara/formats/vector_json.hpp"

namespace samara {
namespace {

double drag(const LoadEntry& entry, const Vector3d& direction) {
    return -entry.force.dot(direction);
}

double drag_error(const LoadEntryError& error, const Vector3d& direction) {
    return error.force.cwiseProduct(direction).norm();
}

void print_vector(const char* name, const Vector3d& value, const Vector3d& error) {
    print_result("  {:<18}({:.4f}, {:.4f}, {:.4f}) +- ({:.4f}, {:.4f}, {:.4f})\n", name, value.x(), value.y(),
                 value.z(), error.x(), error.y(), error.z());
}

}  // namespace

void print_lookup(const LoadTables& tables, const Vector3d& direction, double reynolds_number) {
    const LoadEntry entry = look_up(tables, direction, reynolds_number);
    const LoadEntryError error = look_up_error(tables, direction, reynolds_number);
    print_result("moving along ({:.4f}, {:.4f}, {:.4f}) in shape axes at Reynolds number {:.6g}\n",
                 direction.x(), direction.y(), direction.z(), reynolds_number);
    print_result("  {:<18}{:.4f} +- {:.4f}\n", "drag coefficient", drag(entry, direction),
                 drag_error(error, direction));
    print_vector("force", entry.force, error.force);
    print_vector("moment", entry.moment, error.moment);
    print_result("  {:<18}{:.5f} +- {:.5f}\n", "k/U^2", entry.turbulent_kinetic_energy,
                 error.turbulent_kinetic_energy);
    print_result("  {:<18}{:.5f} +- {:.5f}\n", "epsilon L/U^3", entry.dissipation_rate,
                 error.dissipation_rate);
    print_result("coefficients on A = pi L^2/4 and L = {:.6g} m, with standard errors\n",
                 tables.reference_length);
}

nlohmann::json lookup_as_json(const LoadTables& tables, const Vector3d& direction, double reynolds_number) {
    const LoadEntry entry = look_up(tables, direction, reynolds_number);
    const LoadEntryError error = look_up_error(tables, direction, reynolds_number);
    return {{"direction", as_json(direction)},
            {"reynolds_number", reynolds_number},
            {"reference_length", tables.reference_length},
            {"drag_coefficient", drag(entry, direction)},
            {"drag_coefficient_error", drag_error(error, direction)},
            {"force", as_json(entry.force)},
            {"force_error", as_json(error.force)},
            {"moment", as_json(entry.moment)},
            {"moment_error", as_json(error.moment)},
            {"turbulent_kinetic_energy", entry.turbulent_kinetic_energy},
            {"turbulent_kinetic_energy_error", error.turbulent_kinetic_energy},
            {"dissipation_rate", entry.dissipation_rate},
            {"dissipation_rate_error", error.dissipation_rate}};
}

}  // namespace samara
