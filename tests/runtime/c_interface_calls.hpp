#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "samara.h"
#include "samara/core/body/body_file.hpp"
#include "support/known_bodies.hpp"
#include "support/temporary_folder.hpp"

// The C interface as tests call it: what they do not expect to fail fails the test.

namespace samara::test {

/// A caller's buffer for error texts.
struct Text {
    std::array<char, 256> bytes{};
    [[nodiscard]] std::string text() const { return bytes.data(); }
};

// Calls a function of the interface with a buffer at its end.
#define CALL(function, ...) function(__VA_ARGS__, error.bytes.data(), error.bytes.size())

using BodyPointer = std::unique_ptr<samara_body, void (*)(samara_body*)>;
using SimulationPointer = std::unique_ptr<samara_simulation, void (*)(samara_simulation*)>;

inline Body rubber() {
    Body body = test::rubber_ellipsoid();
    body.name = "rubber";
    body.source = "invented";
    body.tables = test::blunt_tables(body, 4);
    return body;
}

/// The rubber body with coefficients of a moving body that are not the defaults.
inline Body rubber_with_own_coefficients() {
    Body body = rubber();
    body.dynamic = test::lopsided_shape().dynamic;
    return body;
}

/// A body's file, in a folder of its own, and the body as the interface reads it.
class BodyOnDisk {
  public:
    explicit BodyOnDisk(const Body& body = rubber()) {
        write_body_file(file(), body);
        Text error;
        samara_body* loaded = nullptr;
        EXPECT_EQ(CALL(samara_body_load, file().c_str(), &loaded), SAMARA_OK) << error.text();
        body_.reset(loaded);
    }
    [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "rubber.body.h5"; }
    [[nodiscard]] const samara_body* get() const { return body_.get(); }

  private:
    test::TemporaryFolder folder_;
    BodyPointer body_{nullptr, samara_body_free};
};

inline samara_settings default_settings() {
    samara_settings settings;
    EXPECT_EQ(samara_default_settings(&settings, sizeof settings, nullptr, 0), SAMARA_OK);
    return settings;
}

inline samara_body_group rubber_group(std::uint32_t count = 1) {
    samara_body_group kind;
    EXPECT_EQ(samara_default_body_group(&kind, sizeof kind, nullptr, 0), SAMARA_OK);
    kind.density = 1200.0;
    kind.count = count;
    kind.orientation[0] = 0.8;
    kind.orientation[2] = -0.6;
    if (count > 1) {
        kind.spread_angle = 1.0;
        kind.spread_position[0] = 0.1;
    }
    return kind;
}

inline SimulationPointer empty_simulation(const samara_settings& settings = default_settings()) {
    Text error;
    samara_simulation* simulation = nullptr;
    EXPECT_EQ(CALL(samara_simulation_create, &settings, &simulation), SAMARA_OK) << error.text();
    return {simulation, samara_simulation_free};
}

inline SimulationPointer simulation_of(const BodyOnDisk& body, const samara_body_group& kind,
                                       const samara_settings& settings = default_settings()) {
    SimulationPointer simulation = empty_simulation(settings);
    Text error;
    EXPECT_EQ(CALL(samara_simulation_add, simulation.get(), body.get(), &kind, nullptr), SAMARA_OK)
        << error.text();
    return simulation;
}

inline std::vector<samara_pose> poses_of(const SimulationPointer& simulation) {
    std::vector<samara_pose> poses(samara_simulation_count(simulation.get()));
    Text error;
    EXPECT_EQ(CALL(samara_get_poses, simulation.get(), 0, poses.size(), poses.data(), 0), SAMARA_OK)
        << error.text();
    return poses;
}

inline std::vector<samara_pose> poses_at(const SimulationPointer& simulation, double time) {
    Text error;
    EXPECT_EQ(CALL(samara_advance_to, simulation.get(), time), SAMARA_OK) << error.text();
    return poses_of(simulation);
}

inline bool same_bytes(const std::vector<samara_pose>& a, const std::vector<samara_pose>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(samara_pose)) == 0;
}

inline std::string state_of(const SimulationPointer& simulation) {
    std::string bytes(samara_state_size(simulation.get()), '\0');
    Text error;
    EXPECT_EQ(CALL(samara_get_state, simulation.get(), bytes.data(), bytes.size()), SAMARA_OK)
        << error.text();
    return bytes;
}

inline samara_status set_state(const SimulationPointer& simulation, const std::string& bytes, Text& error) {
    return CALL(samara_set_state, simulation.get(), bytes.data(), bytes.size());
}

}  // namespace samara::test
