#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "samara.h"
#include "samara/core/base/numbers.hpp"
#include "samara/core/c_interface/guard.hpp"
#include "samara/core/c_interface/members.hpp"
#include "samara/core/c_interface/objects.hpp"
#include "samara/core/c_interface/settings.hpp"

namespace {

using samara::copy;
using samara::fill;
using samara::guarded;
using samara::Pose;
using samara::Quaterniond;
using samara::require;
using samara::StatusError;
using samara::Vector3d;

/// Returns the stride (bytes) of poses of those bodies.
std::size_t checked_stride(const samara_simulation* simulation, std::size_t first, std::size_t count,
                           const samara_pose* poses, std::size_t stride) {
    return samara::checked_stride(simulation, first, count, poses, "poses", stride, sizeof(samara_pose),
                                  alignof(samara_pose));
}

samara_pose c_pose(const Pose& pose, const Vector3d& center_of_mass) {
    samara_pose result{};
    copy(samara::shape_origin(pose, center_of_mass), result.position);
    const Quaterniond& q = pose.orientation;
    const double orientation[4] = {q.w(), q.x(), q.y(), q.z()};
    std::copy_n(orientation, 4, result.orientation);
    copy(pose.velocity, result.velocity);
    copy(pose.angular_velocity, result.angular_velocity);
    return result;
}

Pose checked_pose(const samara_pose& given, std::size_t index, const Vector3d& center_of_mass) {
    Pose pose;
    const auto& q = given.orientation;
    pose.orientation = Quaterniond(q[0], q[1], q[2], q[3]);
    pose.position = Vector3d(given.position);
    pose.velocity = Vector3d(given.velocity);
    pose.angular_velocity = Vector3d(given.angular_velocity);
    double numbers[sizeof given / sizeof(double)];
    std::memcpy(numbers, &given, sizeof given);
    for (const double number : numbers) {
        if (std::abs(number) <= samara::largest_number) continue;
        throw StatusError(SAMARA_INVALID_ARGUMENT,
                          fmt::format("the pose of body {} holds {}, which is not finite or beyond {:.0e}",
                                      index, number, samara::largest_number));
    }
    if (!(pose.orientation.norm() >= 1e-6)) {
        throw StatusError(
            SAMARA_INVALID_ARGUMENT,
            fmt::format("the orientation of body {} must be a quaternion that is not zero", index));
    }
    pose.orientation.normalize();
    pose.position += pose.orientation * center_of_mass;
    return pose;
}

}  // namespace

samara_status samara_default_settings(samara_settings* settings, size_t size, char* error,
                                      size_t error_size) {
    return guarded(error, error_size, [&] { fill(settings, size, samara::default_settings(), "settings"); });
}

samara_status samara_default_body_group(samara_body_group* group, size_t size, char* error,
                                        size_t error_size) {
    return guarded(error, error_size, [&] { fill(group, size, samara::default_group(), "body_group"); });
}

samara_status samara_simulation_create(const samara_settings* settings, samara_simulation** simulation,
                                       char* error, size_t error_size) {
    return guarded(error, error_size, [&] {
        require(simulation, "simulation");
        *simulation = nullptr;
        require(settings, "settings");
        *simulation = new samara_simulation{samara::Simulation(samara::read_settings(*settings))};
    });
}

void samara_simulation_free(samara_simulation* simulation) {
    delete simulation;
}

samara_status samara_simulation_add(samara_simulation* simulation, const samara_body* body,
                                    const samara_body_group* group, size_t* first, char* error,
                                    size_t error_size) {
    return guarded(error, error_size, [&] {
        require(simulation, "simulation");
        require(body, "body");
        require(group, "group");
        const samara::GivenGroup given = samara::of_body(*body->loaded.body, samara::read_group(*group));
        const size_t added = simulation->core.add(body->loaded, given, given, given.name);
        if (first != nullptr) *first = added;
    });
}

size_t samara_simulation_count(const samara_simulation* simulation) {
    return simulation == nullptr ? 0 : simulation->core.size();
}

double samara_simulation_time(const samara_simulation* simulation) {
    return simulation == nullptr ? 0.0 : simulation->core.time();
}

samara_status samara_advance_to(samara_simulation* simulation, double time, char* error, size_t error_size) {
    return guarded(error, error_size, [&] {
        require(simulation, "simulation");
        simulation->core.advance_to(time);
    });
}

samara_status samara_advance_within(samara_simulation* simulation, double time, double seconds, char* error,
                                    size_t error_size) {
    return guarded(error, error_size, [&] {
        require(simulation, "simulation");
        if (!(seconds >= 0.0)) {
            throw StatusError(
                SAMARA_INVALID_ARGUMENT,
                fmt::format("seconds: {} is not 0 or more; give a frame's share, such as 0.004", seconds));
        }
        simulation->core.advance_within(time, seconds);
    });
}

samara_status samara_get_poses(const samara_simulation* simulation, size_t first, size_t count,
                               samara_pose* poses, size_t stride, char* error, size_t error_size) {
    return guarded(error, error_size, [&] {
        const std::size_t bytes = checked_stride(simulation, first, count, poses, stride);
        simulation->core.require_running();
        auto* place = reinterpret_cast<std::byte*>(poses);
        for (size_t i = first; i < first + count; ++i, place += bytes) {
            const samara_pose pose = c_pose(simulation->core.pose(i), simulation->core.center_of_mass(i));
            std::memcpy(place, &pose, sizeof pose);
        }
    });
}

samara_status samara_set_poses(samara_simulation* simulation, size_t first, size_t count,
                               const samara_pose* poses, size_t stride, char* error, size_t error_size) {
    return guarded(error, error_size, [&] {
        const std::size_t bytes = checked_stride(simulation, first, count, poses, stride);
        simulation->core.require_running();
        const auto* place = reinterpret_cast<const std::byte*>(poses);
        std::vector<Pose> checked(count);
        for (size_t i = 0; i < count; ++i, place += bytes) {
            samara_pose given;
            std::memcpy(&given, place, sizeof given);
            checked[i] = checked_pose(given, first + i, simulation->core.center_of_mass(first + i));
        }
        for (size_t i = 0; i < count; ++i) simulation->core.set_pose(first + i, checked[i]);
    });
}

samara_status samara_set_seed(samara_simulation* simulation, uint64_t seed, uint32_t run, char* error,
                              size_t error_size) {
    return guarded(error, error_size, [&] {
        require(simulation, "simulation");
        simulation->core.set_seed(seed, run);
    });
}

size_t samara_state_size(const samara_simulation* simulation) {
    return simulation == nullptr ? 0 : simulation->core.state_size();
}

samara_status samara_get_state(const samara_simulation* simulation, void* bytes, size_t size, char* error,
                               size_t error_size) {
    return guarded(error, error_size, [&] {
        require(simulation, "simulation");
        require(bytes, "bytes");
        const std::string state = simulation->core.state();
        if (size < state.size()) {
            throw StatusError(SAMARA_INVALID_ARGUMENT,
                              fmt::format("size is {}, but the state takes {} bytes", size, state.size()));
        }
        std::memcpy(bytes, state.data(), state.size());
    });
}

samara_status samara_set_state(samara_simulation* simulation, const void* bytes, size_t size, char* error,
                               size_t error_size) {
    return guarded(error, error_size, [&] {
        require(simulation, "simulation");
        require(bytes, "bytes");
        simulation->core.set_state(std::string_view(static_cast<const char*>(bytes), size));
    });
}

samara_status samara_get_report(const samara_simulation* simulation, samara_report* report, char* error,
                                size_t error_size) {
    return guarded(error, error_size, [&] {
        require(simulation, "simulation");
        require(report, "report");
        const samara::StepReport report_of_all = simulation->core.report();
        samara_report filled{};
        filled.steps = report_of_all.steps;
        filled.substeps = report_of_all.implicit_steps;
        filled.most_substeps = report_of_all.most_substeps;
        filled.highest_reynolds_number = report_of_all.highest_reynolds_number;
        fill(report, report->size, filled, "report");
    });
}
