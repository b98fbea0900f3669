// Body files: a recipe of edits on a sound one (hdf5_recipe.hpp).

#include <cmath>
#include <filesystem>
#include <fstream>

#include "harness.hpp"
#include "hdf5_recipe.hpp"
#include "samara.h"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/folders.hpp"
#include "support/test_shapes.hpp"

namespace samara::fuzz {
namespace {

/// A body that the interface loads flies, or one line says why not.
void fly(const samara_body* body) {
    samara_settings settings;
    samara_body_group kind;
    samara_default_settings(&settings, sizeof settings, nullptr, 0);
    samara_default_body_group(&kind, sizeof kind, nullptr, 0);
    kind.density = 1200.0;
    samara_simulation* simulation = nullptr;
    require(samara_simulation_create(&settings, &simulation, nullptr, 0) == SAMARA_OK, "sound settings do");
    samara_status status = samara_simulation_add(simulation, body, &kind, nullptr, nullptr, 0);
    require(status != SAMARA_INTERNAL_ERROR, "adding a body has no internal error");
    if (status == SAMARA_OK) {
        status = samara_advance_to(simulation, 0.02, nullptr, 0);
        require(status == SAMARA_OK || status == SAMARA_OUT_OF_RANGE, "a body that was taken flies");
        samara_pose pose{};
        if (status == SAMARA_OK && samara_get_poses(simulation, 0, 1, &pose, 0, nullptr, 0) == SAMARA_OK) {
            for (const double number : pose.position) require(std::isfinite(number), "poses are finite");
            for (const double number : pose.orientation) require(std::isfinite(number), "poses are finite");
        }
    }
    samara_simulation_free(simulation);
}

}  // namespace

const SeedFile& seed_file() {
    static const SeedFile seed = [] {
        const TemporaryFolder folder;
        write_body_file(folder / "seed.body.h5", test::full_body());
        return read_seed_file(folder / "seed.body.h5");
    }();
    return seed;
}

void feed(std::string_view input) {
    static const TemporaryFolder folder;
    const std::filesystem::path file = folder / "pebble.body.h5";
    std::ofstream(file, std::ios::binary) << seed_file().bytes;
    apply_recipe(input, file);
    const auto body = accepted([&] { return read_body_file(file); });
    samara_body* loaded = nullptr;
    const samara_status status = samara_body_load(file.c_str(), &loaded, nullptr, 0);
    require(body.has_value() == (status == SAMARA_OK), "the C interface takes what samara takes");
    if (!body) return;
    const std::filesystem::path again = folder / "again.body.h5";
    write_body_file(again, *body);
    require(accepted([&] { return read_body_file(again); }).has_value(), "what was read can be written");
    fly(loaded);
    samara_body_free(loaded);
}

}  // namespace samara::fuzz
