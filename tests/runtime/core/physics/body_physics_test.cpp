// One list of what a body is physically: visit_members(). The scene file and the C interface reach all of it.
#include "samara/core/physics/body_physics.hpp"

#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <type_traits>

#include <gtest/gtest.h>

#include "samara/core/c_interface/settings.hpp"
#include "samara/scene/scene_file.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

std::set<std::string> keys() {
    std::set<std::string> result;
    BodyPhysics physics;
    visit_members(physics, [&](const char* key, const auto& /*value*/) { result.insert(key); });
    return result;
}

/// The keys of the members in which the two differ.
std::set<std::string> differences(const BodyPhysics& one, const BodyPhysics& other) {
    std::set<std::string> result;
    visit_members(one, [&](const char* key, const auto& value) {
        visit_members(other, [&](const char* other_key, const auto& other_value) {
            if constexpr (std::is_same_v<decltype(value), decltype(other_value)>) {
                if (std::string(key) == other_key && !(value == other_value)) result.insert(key);
            }
        });
    });
    EXPECT_EQ(result.empty(), one == other);
    return result;
}

struct Line {
    std::string base;  ///< of the [[body]] that the line is added to
    std::string line;
};

BodyPhysics of_scene(const test::TemporaryFolder& folder, const std::string& lines) {
    std::ofstream(folder / "shape.stl") << "solid\n";
    std::ofstream(folder / "scene.toml")
        << "[scene]\nduration = 1\n[[body]]\nname = \"a\"\nshape = \"shape.stl\"\n"
        << lines << "\n";
    return read_scene_file(folder / "scene.toml").bodies.front();
}

TEST(BodyPhysics, IsReachedWholeByTheSceneFile) {
    const std::string mass = "mass = 1\n";
    const std::string coefficients = mass + "loads = \"coefficients\"\n";
    const std::map<std::string, Line> lines = {
        {"density", {"density = 2", "density = 3"}},
        {"mass", {mass, "mass = 2"}},
        {"area_density", {"area_density = 80", "area_density = 90"}},
        {"center_of_mass", {mass, "center_of_mass = [0, 0, 1]"}},
        {"inertia", {mass, "inertia = [1, 1, 1]"}},
        {"loads", {mass + "turbulence = \"none\"\n", "loads = \"none\""}},
        {"drag_coefficient", {coefficients, "drag_coefficient = 2"}},
        {"lift_coefficient", {coefficients, "lift_coefficient = 2"}},
        {"reference_area", {coefficients, "reference_area = 2"}},
        {"normal", {coefficients, "normal = [0, 0, 1]"}},
        {"center_of_pressure", {coefficients, "center_of_pressure = [0, 0, 1]"}},
        {"table_reynolds_number", {mass, "table_reynolds_number = 100"}},
        {"patches", {mass, "patches = 8"}},
        {"added_mass", {mass, "added_mass = false"}},
        {"dynamic_coefficients", {mass, "dynamic_coefficients = \"none\""}},
        {"turbulence", {mass, "turbulence = \"none\""}},
        {"turbulent_kinetic_energy",
         {mass + "turbulence = \"constant\"\ndissipation_rate = 1\n", "turbulent_kinetic_energy = 2"}},
        {"dissipation_rate",
         {mass + "turbulence = \"constant\"\nturbulent_kinetic_energy = 1\n", "dissipation_rate = 2"}},
        {"langevin", {mass, "langevin = \"body-velocity\""}}};
    const test::TemporaryFolder folder;
    for (const std::string& key : keys()) {
        const Line& line = lines.at(key);
        const bool in_base = line.base.find(key + " = ") != std::string::npos &&
                             (key == "mass" || key == "density" || key == "area_density");
        const std::string whole = in_base ? line.line : line.base + line.line;
        const std::string without = key == "turbulent_kinetic_energy" || key == "dissipation_rate"
                                        ? line.base + key + " = 1"
                                        : line.base;
        EXPECT_EQ(differences(of_scene(folder, whole), of_scene(folder, without)),
                  std::set<std::string>{key});
    }
}

TEST(BodyPhysics, IsReachedWholeByTheCInterface) {
    using Change = std::function<void(samara_body_group&)>;
    const std::map<std::string, Change> changes = {
        {"density", [](samara_body_group& k) { k.mass = 0.0, k.density = 2.0; }},
        {"mass", [](samara_body_group& k) { k.mass = 2.0; }},
        {"area_density", [](samara_body_group& k) { k.mass = 0.0, k.area_density = 80.0; }},
        {"center_of_mass", [](samara_body_group& k) { k.has_center_of_mass = 1; }},
        {"inertia", [](samara_body_group& k) { k.inertia[0] = k.inertia[4] = k.inertia[8] = 1.0; }},
        {"loads", [](samara_body_group& k) { k.loads = SAMARA_LOADS_COEFFICIENTS; }},
        {"drag_coefficient", [](samara_body_group& k) { k.drag_coefficient = 2.0; }},
        {"lift_coefficient", [](samara_body_group& k) { k.lift_coefficient = 2.0; }},
        {"reference_area", [](samara_body_group& k) { k.reference_area = 2.0; }},
        {"normal", [](samara_body_group& k) { k.normal[2] = 1.0; }},
        {"center_of_pressure", [](samara_body_group& k) { k.center_of_pressure[2] = 1.0; }},
        {"table_reynolds_number", [](samara_body_group& k) { k.table_reynolds_number = 100.0; }},
        {"patches", [](samara_body_group& k) { k.patches = 8; }},
        {"added_mass", [](samara_body_group& k) { k.added_mass = 0; }},
        {"dynamic_coefficients", [](samara_body_group& k) { k.dynamic_coefficients = SAMARA_DYNAMIC_NONE; }},
        {"turbulence", [](samara_body_group& k) { k.turbulence = SAMARA_TURBULENCE_NONE; }},
        {"turbulent_kinetic_energy", [](samara_body_group& k) { k.turbulent_kinetic_energy = 2.0; }},
        {"dissipation_rate", [](samara_body_group& k) { k.dissipation_rate = 2.0; }},
        {"langevin", [](samara_body_group& k) { k.langevin = SAMARA_LANGEVIN_BODY_VELOCITY; }}};
    samara_body_group plain = default_group();
    plain.mass = 1.0;
    plain.turbulence = SAMARA_TURBULENCE_TABLE;
    for (const std::string& key : keys()) {
        samara_body_group changed = plain;
        changes.at(key)(changed);
        std::set<std::string> expected = {key};
        if (key == "density" || key == "area_density") expected.insert("mass");  // they exclude each other
        EXPECT_EQ(differences(read_group(changed), read_group(plain)), expected);
    }
}

}  // namespace
}  // namespace samara
