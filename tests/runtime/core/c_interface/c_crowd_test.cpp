// Simulations that share a body: each moves as if the body were its own.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "c_interface_calls.hpp"

namespace samara {
namespace {

using namespace samara::test;
using testing::HasSubstr;

struct Difference {
    const char* name;
    void (*apply)(samara_settings& settings, samara_body_group& group);
};

const Difference differences[] = {
    {"density", [](samara_settings&, samara_body_group& group) { group.density = 1500.0; }},
    {"mass",
     [](samara_settings&, samara_body_group& group) {
         group.density = 0.0;
         group.mass = 0.06;
     }},
    {"center of mass",
     [](samara_settings&, samara_body_group& group) {
         group.density = 0.0;
         group.mass = 0.06;
         group.has_center_of_mass = 1;
         group.center_of_mass[2] = 0.002;
     }},
    {"inertia",
     [](samara_settings&, samara_body_group& group) {
         group.density = 0.0;
         group.mass = 0.06;
         for (const std::size_t diagonal : {0U, 4U, 8U}) group.inertia[diagonal] = 2e-5;
     }},
    {"loads", [](samara_settings&, samara_body_group& group) { group.loads = SAMARA_LOADS_NONE; }},
    {"coefficients",
     [](samara_settings&, samara_body_group& group) { group.loads = SAMARA_LOADS_COEFFICIENTS; }},
    {"drag",
     [](samara_settings&, samara_body_group& group) {
         group.loads = SAMARA_LOADS_COEFFICIENTS;
         group.drag_coefficient = 0.7;
     }},
    {"lift",
     [](samara_settings&, samara_body_group& group) {
         group.loads = SAMARA_LOADS_COEFFICIENTS;
         group.lift_coefficient = 0.7;
     }},
    {"area",
     [](samara_settings&, samara_body_group& group) {
         group.loads = SAMARA_LOADS_COEFFICIENTS;
         group.reference_area = 0.003;
     }},
    {"normal",
     [](samara_settings&, samara_body_group& group) {
         group.loads = SAMARA_LOADS_COEFFICIENTS;
         group.lift_coefficient = 0.7;
         group.normal[1] = 1.0;
     }},
    {"center of pressure",
     [](samara_settings&, samara_body_group& group) {
         group.loads = SAMARA_LOADS_COEFFICIENTS;
         group.center_of_pressure[0] = 0.01;
     }},
    {"turbulence",
     [](samara_settings&, samara_body_group& group) { group.turbulence = SAMARA_TURBULENCE_NONE; }},
    {"constant turbulence",
     [](samara_settings&, samara_body_group& group) {
         group.turbulence = SAMARA_TURBULENCE_CONSTANT;
         group.turbulent_kinetic_energy = 1e-3;
         group.dissipation_rate = 1e-2;
     }},
    {"energy",
     [](samara_settings&, samara_body_group& group) {
         group.turbulence = SAMARA_TURBULENCE_CONSTANT;
         group.turbulent_kinetic_energy = 2e-3;
         group.dissipation_rate = 1e-2;
     }},
    {"dissipation",
     [](samara_settings&, samara_body_group& group) {
         group.turbulence = SAMARA_TURBULENCE_CONSTANT;
         group.turbulent_kinetic_energy = 1e-3;
         group.dissipation_rate = 2e-2;
     }},
    {"langevin",
     [](samara_settings&, samara_body_group& group) { group.langevin = SAMARA_LANGEVIN_BODY_VELOCITY; }},
    {"no added mass", [](samara_settings&, samara_body_group& group) { group.added_mass = 0; }},
    {"dynamic coefficients by default",
     [](samara_settings&, samara_body_group& group) { group.dynamic_coefficients = SAMARA_DYNAMIC_DEFAULT; }},
    {"no dynamic coefficients",
     [](samara_settings&, samara_body_group& group) { group.dynamic_coefficients = SAMARA_DYNAMIC_NONE; }},
    {"Reynolds number",
     [](samara_settings&, samara_body_group& group) { group.table_reynolds_number = 1e5; }},
    {"fluid", [](samara_settings& settings, samara_body_group&) { settings.fluid_density = 1025.0; }},
    {"viscosity", [](samara_settings& settings, samara_body_group&) { settings.fluid_viscosity = 2e-3; }},
    {"name", [](samara_settings&, samara_body_group& group) { group.name = "another"; }},
};

TEST(CCrowd, SimulationsThatShareABodyFlyAsIfItWereTheirOwn) {
    const Body rubber = rubber_with_own_coefficients();
    const BodyOnDisk shared(rubber);
    std::vector<std::vector<samara_pose>> motions;
    for (int round = 0; round < 2; ++round) {
        for (const Difference& difference : differences) {
            SCOPED_TRACE(difference.name);
            samara_settings settings = default_settings();
            samara_body_group group = rubber_group();
            difference.apply(settings, group);
            const BodyOnDisk own(rubber);
            const auto alone = poses_at(simulation_of(own, group, settings), 0.4);
            EXPECT_TRUE(same_bytes(poses_at(simulation_of(shared, group, settings), 0.4), alone));
            if (round == 0) motions.push_back(alone);
        }
    }
    for (std::size_t i = 0; i < motions.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            EXPECT_FALSE(same_bytes(motions[i], motions[j]))
                << differences[i].name << " and " << differences[j].name;
        }
    }
}

TEST(CCrowd, ABodyBelowTheGroundIsNamedByItsOwnKind) {
    const BodyOnDisk shared;
    samara_settings settings = default_settings();
    settings.has_ground = 1;
    settings.ground = -1.0;
    samara_body_group group = rubber_group();
    group.name = "high";
    const SimulationPointer high = simulation_of(shared, group, settings);
    group.name = "deep";
    group.position[2] = -2.0;
    Text error;
    EXPECT_EQ(CALL(samara_simulation_add, high.get(), shared.get(), &group, nullptr),
              SAMARA_INVALID_ARGUMENT);
    EXPECT_THAT(error.text(), HasSubstr("'deep'"));
}

}  // namespace
}  // namespace samara
