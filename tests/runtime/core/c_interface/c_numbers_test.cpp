// Every number that the C interface takes, at the ends of the range of doubles: accepted numbers are
// simulated.

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "c_interface_calls.hpp"

namespace samara {
namespace {

using namespace test;
using testing::HasSubstr;

const std::vector<double> hard_numbers = {0.0,      5e-324,
                                          1e-310,   2e-308,
                                          1e-200,   1e-100,
                                          1e-60,    1e-30,
                                          1e30,     1.1e30,
                                          1e60,     1e100,
                                          1e154,    1e200,
                                          1.7e308,  std::numeric_limits<double>::infinity(),
                                          -5e-324,  -1e-200,
                                          -1e30,    -1e200,
                                          -1.7e308, std::numeric_limits<double>::quiet_NaN()};

bool is_sound(const samara_pose& pose) {
    double norm = 0.0;
    for (const double number : pose.orientation) norm += number * number;
    bool finite = std::abs(std::sqrt(norm) - 1.0) < 1e-6;
    for (int i = 0; i < 3; ++i) {
        finite = finite && std::isfinite(pose.position[i]) && std::isfinite(pose.velocity[i]) &&
                 std::isfinite(pose.angular_velocity[i]);
    }
    return finite;
}

/// Checks the poses now, and advances; the statuses may be errors, but all values that are returned are
/// sound.
void expect_sound(const SimulationPointer& simulation, const std::string& what) {
    Text error;
    for (const double time : {0.0, 0.001, 0.0055, 0.02}) {
        if (CALL(samara_advance_to, simulation.get(), time) != SAMARA_OK) {
            EXPECT_FALSE(error.text().empty()) << what;
            return;
        }
        samara_pose pose;
        if (CALL(samara_get_poses, simulation.get(), 0, 1, &pose, 0) != SAMARA_OK) return;
        EXPECT_TRUE(is_sound(pose)) << what << " at " << time << " s";
    }
}

struct Member {
    const char* name;
    double* place;
};

std::vector<Member> members_of(samara_settings& s) {
    return {{"fluid_density", &s.fluid_density},
            {"fluid_viscosity", &s.fluid_viscosity},
            {"current", &s.current[1]},
            {"gust_amplitude", &s.gust_amplitude[0]},
            {"gust_period", &s.gust_period},
            {"gravity", &s.gravity[2]},
            {"step", &s.step},
            {"ground", &s.ground}};
}

std::vector<Member> members_of(samara_body_group& k) {
    return {{"density", &k.density},
            {"mass", &k.mass},
            {"center_of_mass", &k.center_of_mass[0]},
            {"inertia", &k.inertia[4]},
            {"position", &k.position[2]},
            {"orientation", &k.orientation[1]},
            {"velocity", &k.velocity[0]},
            {"angular_velocity", &k.angular_velocity[1]},
            {"start", &k.start},
            {"spread_position", &k.spread_position[2]},
            {"spread_angle", &k.spread_angle},
            {"drag_coefficient", &k.drag_coefficient},
            {"lift_coefficient", &k.lift_coefficient},
            {"reference_area", &k.reference_area},
            {"normal", &k.normal[0]},
            {"center_of_pressure", &k.center_of_pressure[1]},
            {"turbulent_kinetic_energy", &k.turbulent_kinetic_energy},
            {"dissipation_rate", &k.dissipation_rate},
            {"table_reynolds_number", &k.table_reynolds_number}};
}

samara_body_group settling_group(int variant) {
    samara_body_group group = rubber_group();
    group.count = 2;
    group.velocity[2] = 0.1;
    group.angular_velocity[0] = 1.0;
    if (variant == 0) return group;
    group.loads = SAMARA_LOADS_COEFFICIENTS;
    group.turbulence = SAMARA_TURBULENCE_CONSTANT;
    group.turbulent_kinetic_energy = 1e-4;
    group.dissipation_rate = 1e-3;
    group.density = 0.0;
    group.mass = 0.04;
    group.has_center_of_mass = 1;
    for (const std::size_t diagonal : {0U, 4U, 8U}) group.inertia[diagonal] = 1e-5;
    return group;
}

samara_settings lively_settings(int variant) {
    samara_settings settings = default_settings();
    settings.gust_amplitude[1] = variant == 0 ? 0.0 : 0.1;
    settings.has_ground = variant;
    settings.ground = -1.0;
    return settings;
}

TEST(CNumbers, OfSettingsAreRefusedOrFlown) {
    const BodyOnDisk body;
    for (const int variant : {0, 1}) {
        samara_settings settings = lively_settings(variant);
        for (const Member& member : members_of(settings)) {
            const double before = *member.place;
            for (const double number : hard_numbers) {
                *member.place = number;
                const std::string what = fmt::format("{} = {}", member.name, number);
                Text error;
                samara_simulation* created = nullptr;
                if (CALL(samara_simulation_create, &settings, &created) != SAMARA_OK) {
                    EXPECT_THAT(error.text(), testing::StartsWith(member.name)) << what;
                    continue;
                }
                const SimulationPointer simulation(created, samara_simulation_free);
                const samara_body_group group = settling_group(variant);
                if (CALL(samara_simulation_add, created, body.get(), &group, nullptr) == SAMARA_OK) {
                    expect_sound(simulation, what);
                }
            }
            *member.place = before;
        }
    }
}

TEST(CNumbers, OfKindsAreRefusedOrFlown) {
    const BodyOnDisk body;
    for (const int variant : {0, 1}) {
        samara_body_group group = settling_group(variant);
        for (const Member& member : members_of(group)) {
            const double before = *member.place;
            for (const double number : hard_numbers) {
                *member.place = number;
                const SimulationPointer simulation = empty_simulation(lively_settings(variant));
                Text error;
                if (CALL(samara_simulation_add, simulation.get(), body.get(), &group, nullptr) != SAMARA_OK) {
                    EXPECT_FALSE(error.text().empty());
                    EXPECT_EQ(samara_simulation_count(simulation.get()), 0U);
                    continue;
                }
                expect_sound(simulation, fmt::format("{} = {}", member.name, number));
            }
            *member.place = before;
        }
    }
}

TEST(CNumbers, OfPosesAreRefusedOrFlown) {
    const BodyOnDisk body;
    for (int member = 0; member < 13; ++member) {
        for (const double number : hard_numbers) {
            const SimulationPointer simulation = simulation_of(body, settling_group(0));
            samara_pose pose = poses_of(simulation)[0];
            reinterpret_cast<double*>(&pose)[member] = number;
            Text error;
            const samara_status status = CALL(samara_set_poses, simulation.get(), 0, 1, &pose, 0);
            EXPECT_TRUE(status == SAMARA_OK || error.text().find("body 0") != std::string::npos);
            expect_sound(simulation, fmt::format("member {} = {}", member, number));
        }
    }
}

TEST(CNumbers, OfAnOrientationTooLongToMeasureAreRefused) {
    const BodyOnDisk body;
    const SimulationPointer simulation = simulation_of(body, rubber_group());
    const std::vector<samara_pose> before = poses_of(simulation);
    samara_pose pose = before[0];
    pose.orientation[0] = 1e200;
    Text error;
    EXPECT_EQ(CALL(samara_set_poses, simulation.get(), 0, 1, &pose, 0), SAMARA_INVALID_ARGUMENT);
    EXPECT_THAT(error.text(), HasSubstr("1e+200"));
    EXPECT_TRUE(same_bytes(poses_of(simulation), before));
}

TEST(CNumbers, OfAStartThatIsNeverReachedAreRefused) {
    const BodyOnDisk body;
    const SimulationPointer simulation = empty_simulation();
    samara_body_group group = rubber_group();
    Text error;
    for (const double start : {1e308, 1e30, 2.1e7}) {
        group.start = start;
        EXPECT_EQ(CALL(samara_simulation_add, simulation.get(), body.get(), &group, nullptr),
                  SAMARA_INVALID_ARGUMENT);
        EXPECT_THAT(error.text(), HasSubstr("start"));
    }
    group.start = 1e7;
    EXPECT_EQ(CALL(samara_simulation_add, simulation.get(), body.get(), &group, nullptr), SAMARA_OK);
    EXPECT_TRUE(is_sound(poses_at(simulation, 1.0)[0]));
}

}  // namespace
}  // namespace samara
