// Functions that game engines and robotics simulators need beyond the motion.
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>

#include <fmt/format.h>

#include "samara.h"
#include "samara/core/c_interface/guard.hpp"
#include "samara/core/c_interface/members.hpp"
#include "samara/core/c_interface/objects.hpp"

namespace {

using samara::copy;
using samara::guarded;
using samara::Matrix6d;
using samara::require;
using samara::Simulation;
using samara::Vector3d;
using samara::Wrench;

/// Returns the simulation behind the handle. Throws StatusError where it has stopped or has no such body.
template <typename Simulation>
auto& simulation_of(Simulation* simulation, std::size_t body) {
    samara::require_bodies(simulation, 0, 0);
    auto& core = simulation->core;
    core.require_running();
    if (body >= core.size())
        samara::reject("body", fmt::format("is {}, but there are {}; count from 0", body, core.size()));
    return core;
}

/// Returns the simulation behind the handle as running() does. Throws StatusError where the body has been
/// removed.
template <typename Simulation>
auto& simulation_with(Simulation* simulation, std::size_t body) {
    auto& core = simulation_of(simulation, body);
    if (core.is_removed(body)) {
        samara::reject("body", fmt::format("{} is removed; put it back with samara_set_poses", body));
    }
    return core;
}

Vector3d three(const double* values, const char* name) {
    require(values, name);
    const double copied[3] = {values[0], values[1], values[2]};
    return samara::vector(copied, name);
}

/// Returns the wrench of a force, or impulse, at a point (m, world; null: the centre of mass).
Wrench wrench_at(const Simulation& core, std::size_t body, const double* force, const char* name,
                 const double* point) {
    Wrench wrench{.force = three(force, name), .moment = Vector3d::Zero()};
    if (point == nullptr) return wrench;
    wrench.moment = (three(point, "point") - core.pose(body).position).cross(wrench.force);
    return wrench;
}

void copy(const Matrix6d& from, double (&to)[36]) {
    const Eigen::Matrix<double, 6, 6, Eigen::RowMajor> rows = from;
    std::copy_n(rows.data(), 36, to);
}

}  // namespace

samara_status samara_get_sizes(const samara_simulation* simulation, size_t first, size_t count, double* sizes,
                               char* error, size_t error_size) {
    return guarded(error, error_size, [&] {
        samara::require_bodies(simulation, first, count);
        if (count > 0) require(sizes, "sizes");
        for (std::size_t i = 0; i < count; ++i) sizes[i] = simulation->core.size_of(first + i);
    });
}

samara_status samara_get_mass_properties(const samara_simulation* simulation, size_t body,
                                         samara_mass_properties* properties, char* error, size_t error_size) {
    return guarded(error, error_size, [&] {
        const Simulation& core = simulation_of(simulation, body);
        require(properties, "properties");
        properties->mass = core.mass(body);
        copy(core.center_of_mass(body), properties->center_of_mass);
        const samara::Matrix3d inertia = core.inertia(body);
        std::copy_n(inertia.data(), 9, properties->inertia);
    });
}

samara_status samara_add_force(samara_simulation* simulation, size_t body, const double force[3],
                               const double* point, char* error, size_t error_size) {
    return guarded(error, error_size, [&] {
        Simulation& core = simulation_with(simulation, body);
        core.add_wrench(body, wrench_at(core, body, force, "force", point));
    });
}

samara_status samara_add_moment(samara_simulation* simulation, size_t body, const double moment[3],
                                char* error, size_t error_size) {
    return guarded(error, error_size, [&] {
        simulation_with(simulation, body)
            .add_wrench(body, {.force = Vector3d::Zero(), .moment = three(moment, "moment")});
    });
}

samara_status samara_add_impulse(samara_simulation* simulation, size_t body, const double impulse[3],
                                 const double* point, char* error, size_t error_size) {
    return guarded(error, error_size, [&] {
        Simulation& core = simulation_with(simulation, body);
        core.add_impulse(body, wrench_at(core, body, impulse, "impulse", point));
    });
}

samara_status samara_add_angular_impulse(samara_simulation* simulation, size_t body,
                                         const double angular_impulse[3], char* error, size_t error_size) {
    return guarded(error, error_size, [&] {
        simulation_with(simulation, body)
            .add_impulse(body,
                         {.force = Vector3d::Zero(), .moment = three(angular_impulse, "angular_impulse")});
    });
}

samara_status samara_remove(samara_simulation* simulation, size_t first, size_t count, char* error,
                            size_t error_size) {
    return guarded(error, error_size, [&] {
        samara::require_bodies(simulation, first, count);
        simulation->core.require_running();
        for (std::size_t i = 0; i < count; ++i) simulation->core.remove(first + i);
    });
}

int samara_is_removed(const samara_simulation* simulation, size_t body) {
    const bool known = simulation != nullptr && body < simulation->core.size();
    return known && simulation->core.is_removed(body) ? 1 : 0;
}

samara_status samara_watch_contacts(samara_simulation* simulation, int32_t watch, char* error,
                                    size_t error_size) {
    return guarded(error, error_size, [&] {
        require(simulation, "simulation");
        simulation->core.watch_contacts(watch != 0);
    });
}

samara_status samara_take_contacts(samara_simulation* simulation, size_t first, size_t count,
                                   samara_contact* contacts, size_t stride, char* error, size_t error_size) {
    return guarded(error, error_size, [&] {
        const std::size_t bytes =
            samara::checked_stride(simulation, first, count, contacts, "contacts", stride,
                                   sizeof(samara_contact), alignof(samara_contact));
        auto* place = reinterpret_cast<std::byte*>(contacts);
        for (std::size_t i = first; i < first + count; ++i, place += bytes) {
            const samara::ContactRecord record = simulation->core.take_contacts(i);
            samara_contact contact{};
            copy(record.impulse, contact.impulse);
            contact.strongest = record.strongest;
            copy(record.point, contact.point);
            copy(record.normal, contact.normal);
            contact.time = record.time;
            contact.obstacle = record.body < 0 ? record.obstacle : -2 - record.body;
            contact.at_rest = simulation->core.is_at_rest(i) ? 1 : 0;
            std::memcpy(place, &contact, sizeof contact);
        }
    });
}

samara_status samara_get_fluid_forces(const samara_simulation* simulation, size_t first, size_t count,
                                      samara_fluid_forces* forces, size_t stride, char* error,
                                      size_t error_size) {
    return guarded(error, error_size, [&] {
        const std::size_t bytes =
            samara::checked_stride(simulation, first, count, forces, "forces", stride,
                                   sizeof(samara_fluid_forces), alignof(samara_fluid_forces));
        auto* place = reinterpret_cast<std::byte*>(forces);
        for (std::size_t i = first; i < first + count; ++i, place += bytes) {
            const samara::FluidForces found = simulation->core.fluid_forces(i);
            samara_fluid_forces result{};
            double* const parts[] = {result.buoyancy, result.inertia, result.drag, result.lift, result.noise};
            static_assert(std::size(parts) == samara::parts_of_fluid_forces.size());
            for (std::size_t part = 0; part < std::size(parts); ++part) {
                const samara::Wrench& wrench = found.*samara::parts_of_fluid_forces[part].second;
                std::copy_n(wrench.moment.data(), 3, parts[part]);
                std::copy_n(wrench.force.data(), 3, parts[part] + 3);
            }
            std::memcpy(place, &result, sizeof result);
        }
    });
}

samara_status samara_get_fluid_load(const samara_simulation* simulation, size_t body, samara_fluid_load* load,
                                    char* error, size_t error_size) {
    return guarded(error, error_size, [&] {
        const Simulation& core = simulation_with(simulation, body);
        require(load, "load");
        const samara::FluidLoad found = core.fluid_load(body);
        std::copy_n(found.wrench.data(), 6, load->wrench);
        copy(found.added_inertia, load->added_inertia);
        copy(found.damping, load->damping);
    });
}
