// For MuJoCo from 2.3 on: the plugin samara.fluid, with its state in mjData's plugin_state.
#include <mujoco/mujoco.h>

#if mjVERSION_HEADER >= 230

#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "runtime/engines/mujoco/fluid_bodies.hpp"
#include "runtime/engines/mujoco/inertia_matrix.hpp"

namespace samara::mujoco {
namespace {

/// Returns the fluid of an instance: the bodies that name it in the XML.
FluidBodies fluid_of(const mjModel& model, int instance) {
    std::vector<int> bodies;
    for (int body = 1; body < model.nbody; ++body) {
        if (model.body_plugin[body] == instance) bodies.push_back(body);
    }
    return {model, bodies, [&](const char* key) {
                const char* given = mj_getPluginConfig(&model, instance, key);
                return std::string(given == nullptr ? "" : given);
            }};
}

/// Runs work on a model; says what is wrong in a warning and returns -1 where it fails.
template <typename Work>
int tried(const Work& work) {
    try {
        return work();
    } catch (const std::exception& wrong) {
        mju_warning("samara: %s", wrong.what());
        return -1;
    }
}

FluidBodies*& held(const mjData& data, int instance) {
    return reinterpret_cast<FluidBodies*&>(data.plugin_data[instance]);
}

int state_size(const mjModel* model, int instance) {
    return tried([&] { return static_cast<int>(fluid_of(*model, instance).state_size()); });
}

int make(const mjModel* model, mjData* data, int instance) {
    return tried([&] {
        held(*data, instance) = new FluidBodies(fluid_of(*model, instance));
        return 0;
    });
}

void destroy(mjData* data, int instance) {
    delete std::exchange(held(*data, instance), nullptr);
}

void reset(const mjModel* model, mjtNum* state, void*, int instance) {
    mju_zero(state, model->plugin_statenum[instance]);
}

/// Whether the instance is the first, or the last, of samara's in its model.
bool is_end(const mjModel& model, int instance, int direction) {
    for (int i = instance + direction; i >= 0 && i < model.nplugin; i += direction) {
        if (model.plugin[i] == model.plugin[instance]) return false;
    }
    return true;
}

void compute(const mjModel* model, mjData* data, int instance, int) {
    try {
        FluidBodies*& fluid = held(*data, instance);
        if (!fluid->fits(*model)) *fluid = fluid_of(*model, instance);
        if (is_end(*model, instance, -1)) reset_inertia(*model, *data);
        fluid->apply(*model, *data, data->plugin_state + model->plugin_stateadr[instance]);
        if (is_end(*model, instance, 1)) renew_inertia(*model, *data);
    } catch (const std::exception& wrong) {
        mju_error("samara: %s", wrong.what());
    }
}

[[gnu::constructor]] void install() {
    mjpPlugin plugin;
    mjp_defaultPlugin(&plugin);
    plugin.name = "samara.fluid";
    plugin.nattribute = static_cast<int>(std::size(setting_keys));
    plugin.attributes = setting_keys;
    plugin.capabilityflags = mjPLUGIN_PASSIVE;
    plugin.nstate = state_size;
    plugin.init = make;
    plugin.destroy = destroy;
    plugin.reset = reset;
    plugin.compute = compute;
    mjp_registerPlugin(&plugin);
}

}  // namespace
}  // namespace samara::mujoco

#endif
