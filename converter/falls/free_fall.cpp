#include "converter/falls/free_fall.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

FreeFall as_fall(const nlohmann::json& json) {
    FreeFall fall;
    fall.name = json.at("name").get<std::string>();
    fall.mesh = json.at("mesh").get<std::string>();
    fall.closure = closure_of(json.at("closure").get<std::string>());
    fall.reynolds_number = json.at("reynolds_number").get<double>();
    fall.length = json.at("length").get<double>();
    fall.speed = json.at("speed").get<double>();
    fall.fluid_density = json.at("fluid_density").get<double>();
    fall.axes = matrix_of(json.at("axes"));
    fall.volume = json.at("volume").get<double>();
    fall.mass = json.at("mass").get<double>();
    fall.center_of_mass = vector_of(json.at("center_of_mass"));
    fall.principal_axes = matrix_of(json.at("principal_axes"));
    fall.principal_moments = vector_of(json.at("principal_moments"));
    fall.gravity = vector_of(json.at("gravity"));
    fall.velocity = vector_of(json.at("velocity"));
    fall.angular_velocity = vector_of(json.at("angular_velocity"));
    fall.duration = json.at("duration").get<double>();
    fall.time_step = json.at("time_step").get<double>();
    fall.outer_correctors = json.at("outer_correctors").get<int>();
    fall.acceleration_relaxation = json.at("acceleration_relaxation").get<double>();
    fall.field_interval = json.value("field_interval", 0.0);
    return fall;
}

void check(const FreeFall& fall) {
    const auto require = [](bool holds, const char* what) {
        if (!holds) throw Error(fmt::format("'{}' is not positive", what));
    };
    require(fall.reynolds_number > 0.0, "reynolds_number");
    require(fall.length > 0.0, "length");
    require(fall.speed > 0.0, "speed");
    require(fall.fluid_density > 0.0, "fluid_density");
    require(fall.volume > 0.0, "volume");
    require(fall.mass > 0.0, "mass");
    require(fall.time_step > 0.0, "time_step");
    require(fall.duration > 0.0, "duration");
}

}  // namespace

std::string free_fall_json(const FreeFall& fall) {
    nlohmann::ordered_json json = {{"name", fall.name},
                                   {"mesh", fall.mesh},
                                   {"closure", name_of(fall.closure)},
                                   {"reynolds_number", fall.reynolds_number},
                                   {"length", fall.length},
                                   {"speed", fall.speed},
                                   {"fluid_density", fall.fluid_density},
                                   {"axes", rows_as_json(fall.axes)},
                                   {"volume", fall.volume},
                                   {"mass", fall.mass},
                                   {"center_of_mass", as_json(fall.center_of_mass)},
                                   {"principal_axes", rows_as_json(fall.principal_axes)},
                                   {"principal_moments", as_json(fall.principal_moments)},
                                   {"gravity", as_json(fall.gravity)},
                                   {"velocity", as_json(fall.velocity)},
                                   {"angular_velocity", as_json(fall.angular_velocity)},
                                   {"duration", fall.duration},
                                   {"time_step", fall.time_step},
                                   {"outer_correctors", fall.outer_correctors},
                                   {"acceleration_relaxation", fall.acceleration_relaxation}};
    if (fall.field_interval > 0.0) json["field_interval"] = fall.field_interval;
    return json.dump(2) + "\n";
}

FreeFall read_free_fall(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "fall.json";
    try {
        if (!std::filesystem::exists(file)) throw Error("is missing");
        FreeFall fall = as_fall(parse_json(read_bytes(file)));
        check(fall);
        return fall;
    } catch (const nlohmann::json::exception& reason) {
        throw Error(fmt::format("{}: an entry is missing or of the wrong type ({}); make the case again",
                                file.string(), reason.what()));
    } catch (const Error& reason) {
        throw Error(fmt::format("{}: {}; make the case again", file.string(), reason.what()));
    }
}

}  // namespace samara
