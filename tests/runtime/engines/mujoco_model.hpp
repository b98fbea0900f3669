#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>
#include <unistd.h>

namespace samara::test {

/// The ready-baked body of that name.
inline std::string body_file(const std::string& name) {
    return SAMARA_BODIES "/" + name + ".body.h5";
}

/// A model in samara's fluid, as a user writes it: texts for a MuJoCo without plugins, else the plugin.
struct FluidModel {
    std::map<std::string, std::string> settings;  ///< of the fluid, for all bodies
    std::vector<std::string> bodies;              ///< which are in the fluid
    std::string worldbody;                        ///< with "{fluid}" inside each body that is in the fluid
    std::string option = "timestep='0.002'";      ///< attributes of <option>
    std::string rest = {};                        ///< other elements

    [[nodiscard]] std::string xml() const {
        std::string text = "<mujoco><option gravity='0 0 -9.81' " + option + "/>" + rest;
        std::string world = worldbody;
#if mjVERSION_HEADER < 230
        const std::string inside;
        text += "<size nuserdata='2000'/><custom>";
        for (const auto& [key, value] : settings) {
            if (key != "file") text += fmt::format("<text name='samara:{}' data='{}'/>", key, value);
        }
        for (const std::string& body : bodies)
            text += fmt::format("<text name='samara:{}:file' data='{}'/>", body, settings.at("file"));
        text += "</custom>";
#else
        const std::string inside = "<plugin instance='fluid'/>";
        text += "<extension><plugin plugin='samara.fluid'><instance name='fluid'>";
        for (const auto& [key, value] : settings)
            text += fmt::format("<config key='{}' value='{}'/>", key, value);
        text += "</instance></plugin></extension>";
#endif
        for (std::size_t at = world.find("{fluid}"); at != std::string::npos; at = world.find("{fluid}"))
            world.replace(at, 7, inside);
        return text + "<worldbody>" + world + "</worldbody></mujoco>";
    }
};

using ModelPointer = std::unique_ptr<mjModel, void (*)(mjModel*)>;
using DataPointer = std::unique_ptr<mjData, void (*)(mjData*)>;

inline ModelPointer load(const FluidModel& model) {
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("samara-" + std::to_string(::getpid()) + ".xml");
    std::ofstream(file) << model.xml();
    char reason[1000] = "";
    mjModel* loaded = mj_loadXML(file.c_str(), nullptr, reason, sizeof reason);
    std::filesystem::remove(file);
    if (loaded == nullptr) {
        std::fprintf(stderr, "%s\n", reason);
        std::exit(1);
    }
    return {loaded, mj_deleteModel};
}

inline DataPointer start(const ModelPointer& model) {
    return {mj_makeData(model.get()), mj_deleteData};
}

inline void run(const ModelPointer& model, const DataPointer& data, int steps) {
    for (int i = 0; i < steps; ++i) mj_step(model.get(), data.get());
}

}  // namespace samara::test
