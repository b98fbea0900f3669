// For MuJoCo before 2.3, which has no plugins: a callback, with the fluid in the model's <custom> texts and
// its state in mjData's userdata. The library installs it when it is loaded.
#include <mujoco/mujoco.h>

#if mjVERSION_HEADER < 230

#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "runtime/engines/mujoco/fluid_bodies.hpp"
#include "runtime/engines/mujoco/inertia_matrix.hpp"

namespace samara::mujoco {
namespace {

constexpr std::string_view prefix = "samara:";

/// What the library has made of one model.
struct Coupled {
    std::string names, texts;  ///< the model's, to see another model at the same address
    std::vector<FluidBodies> fluids;
    std::size_t state_size = 0;
};

/// Returns the data of the model's text of that name, or empty.
std::string text(const mjModel& model, const std::string& name) {
    const int id = mj_name2id(&model, mjOBJ_TEXT, name.c_str());
    return id < 0 ? "" : std::string(model.text_data + model.text_adr[id]);
}

/// Throws ModelError for a text with samara's prefix that names no body, or no key.
void check_text(const mjModel& model, const std::string& name) {
    const std::string rest = name.substr(prefix.size());
    const std::size_t colon = rest.rfind(':');
    const std::string key = colon == std::string::npos ? rest : rest.substr(colon + 1);
    if (std::find(std::begin(setting_keys), std::end(setting_keys), key) == std::end(setting_keys))
        throw ModelError("text \"" + name + "\": there is no key \"" + key + "\"");
    if (colon != std::string::npos && mj_name2id(&model, mjOBJ_BODY, rest.substr(0, colon).c_str()) < 0)
        throw ModelError("text \"" + name + "\": the model has no such body");
}

void couple(const mjModel& model, Coupled& made) {
    made = {};
    made.names.assign(model.names, static_cast<std::size_t>(model.nnames));
    made.texts.assign(model.text_data, static_cast<std::size_t>(model.ntextdata));
    for (int i = 0; i < model.ntext; ++i) {
        const std::string name = model.names + model.name_textadr[i];
        if (name.starts_with(prefix)) check_text(model, name);
    }
    for (int body = 1; body < model.nbody; ++body) {
        const std::string own = std::string(prefix) + (model.names + model.name_bodyadr[body]) + ":";
        if (text(model, own + "file").empty()) continue;
        made.fluids.emplace_back(model, std::vector<int>{body}, [&](const char* key) {
            std::string given = text(model, own + key);
            return given.empty() ? text(model, std::string(prefix) + key) : given;
        });
        made.state_size += made.fluids.back().state_size();
    }
    if (made.state_size > static_cast<std::size_t>(model.nuserdata)) {
        throw ModelError("the fluid's state needs room in mjData: write <size nuserdata=\"" +
                         std::to_string(made.state_size) + "\"/> into the model");
    }
}

/// Each thread has its own simulations, which serve every mjData of a model.
Coupled& coupled(const mjModel& model) {
    thread_local std::unordered_map<const mjModel*, Coupled> all;
    if (all.size() > 16 && !all.contains(&model)) all.clear();  // of models that are long gone
    Coupled& made = all[&model];
    const bool same =
        made.names == std::string_view(model.names, static_cast<std::size_t>(model.nnames)) &&
        made.texts == std::string_view(model.text_data, static_cast<std::size_t>(model.ntextdata)) &&
        std::all_of(made.fluids.begin(), made.fluids.end(),
                    [&](const FluidBodies& fluid) { return fluid.fits(model); });
    if (!same) couple(model, made);
    return made;
}

void add_fluid(const mjModel* model, mjData* data) {
    try {
        Coupled& made = coupled(*model);
        if (made.fluids.empty()) return;
        reset_inertia(*model, *data);
        mjtNum* state = data->userdata;
        for (FluidBodies& fluid : made.fluids) {
            fluid.apply(*model, *data, state);
            state += fluid.state_size();
        }
        renew_inertia(*model, *data);
    } catch (const std::exception& wrong) {
        mju_error_s("samara: %s", wrong.what());
    }
}

[[gnu::constructor]] void install() {
    if (mj_version() == mjVERSION_HEADER)
        mjcb_passive = add_fluid;
    else
        mju_error_i("samara: the coupling was built for another version of MuJoCo than %d", mj_version());
}

}  // namespace
}  // namespace samara::mujoco

#endif
