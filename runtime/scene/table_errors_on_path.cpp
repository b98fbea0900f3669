#include "samara/scene/table_errors_on_path.hpp"

#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/dynamics/loads.hpp"
#include "samara/core/simulation/world_pose.hpp"

namespace samara {
namespace {

double mean(double sum, std::uint64_t count) {
    return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

}  // namespace

void TableErrorsOnPath::add(const TableErrorsOnPath& other) {
    force += other.force;
    turbulent_kinetic_energy += other.turbulent_kinetic_energy;
    forces += other.forces;
    turbulent_kinetic_energies += other.turbulent_kinetic_energies;
    poses += other.poses;
    strayed += other.strayed;
}

double TableErrorsOnPath::mean_force() const {
    return mean(force, forces);
}

double TableErrorsOnPath::mean_turbulent_kinetic_energy() const {
    return mean(turbulent_kinetic_energy, turbulent_kinetic_energies);
}

double TableErrorsOnPath::share_strayed() const {
    return mean(static_cast<double>(strayed), poses);
}

TableErrorsOnPath table_errors_on_path(const ImmersedBody& body, const Pose& in_flow) noexcept {
    TableErrorsOnPath errors;
    if (!body.tables || body.tables->errors.size() != body.tables->entries.size()) return errors;
    const Vector3d velocity = centroid_velocity(in_flow, body);
    const double speed = velocity.norm();
    if (!(speed > 0.0)) return errors;
    const Vector3d direction = velocity / speed;
    errors.poses = 1;
    errors.strayed = body.tables->plan.holds(body.tables->axes.transpose() * direction) ? 0 : 1;
    const double reynolds = reynolds_number(body, speed);
    const LoadEntry entry = look_up(*body.tables, direction, reynolds);
    const LoadEntryError error = look_up_error(*body.tables, direction, reynolds);
    const bool of_tables = body.loads == Loads::table || body.loads == Loads::surface;
    if (of_tables && entry.force.norm() > 0.0) {
        errors.force = error.force.norm() / entry.force.norm();
        errors.forces = 1;
    }
    if (body.turbulence == Turbulence::table && entry.turbulent_kinetic_energy > 0.0) {
        errors.turbulent_kinetic_energy = error.turbulent_kinetic_energy / entry.turbulent_kinetic_energy;
        errors.turbulent_kinetic_energies = 1;
    }
    return errors;
}

}  // namespace samara
