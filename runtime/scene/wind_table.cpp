#include "samara/scene/wind_table.hpp"

#include <limits>
#include <memory>
#include <mutex>
#include <string_view>

#include <fmt/format.h>

#include "samara.h"
#include "samara/core/c_interface/guard.hpp"
#include "samara/core/c_interface/objects.hpp"
#include "samara/core/wind/wind_file.hpp"
#include "samara/formats/toml_table.hpp"

namespace samara {
namespace {

constexpr int most_bands = 1000;
constexpr NumberRange exponent_range = {smallest_number, 1.0, "must be a number above 0, 1 at most"};

double required(TomlTable& table, std::string_view key, const NumberRange& range, std::string_view remedy) {
    const auto number = table.number(key, range);
    if (!number) throw table.error(key, remedy);
    return *number;
}

Vector3d required_vector(TomlTable& table, std::string_view key, std::string_view remedy) {
    const auto vector = table.vector(key);
    if (!vector) throw table.error(key, remedy);
    return *vector;
}

Vector3d direction(TomlTable& table, std::string_view key, const Vector3d& given) {
    if (given.norm() < smallest_number) throw table.error(key, "must not be the zero vector");
    return given.normalized();
}

WindProfile read_profile(TomlTable& table, double ground) {
    using Law = WindProfile::Law;
    WindProfile profile;
    if (!table.text("law")) throw table.error("law", R"(is missing; give "log" or "power")");
    profile.law = choice<Law>(table, "law", {{"log", Law::logarithmic}, {"power", Law::power}}, profile.law);
    const bool logarithmic = profile.law == Law::logarithmic;
    const char* foreign = logarithmic ? "exponent" : "roughness";
    if (table.node(foreign) != nullptr) {
        throw table.error(foreign, logarithmic ? R"(applies only to law = "power"; remove it)"
                                               : R"(applies only to law = "log"; remove it)");
    }
    if (logarithmic) {
        profile.roughness = table.number("roughness", positive_number).value_or(profile.roughness);
    } else {
        profile.exponent = table.number("exponent", exponent_range).value_or(profile.exponent);
    }
    profile.height = table.number("height", positive_number).value_or(profile.height);
    profile.ground = table.number("ground", any_number).value_or(ground);
    table.finish();
    return profile;
}

WindSurfaceLayer read_surface_layer(TomlTable& table) {
    WindSurfaceLayer layer;
    layer.height = table.number("height", non_negative_number).value_or(layer.height);
    layer.roughness = table.number("roughness", positive_number).value_or(layer.roughness);
    table.finish();
    return layer;
}

WindGusts read_gusts(TomlTable& table) {
    using Spectrum = WindGusts::Spectrum;
    WindGusts gusts;
    gusts.spectrum = choice<Spectrum>(table, "spectrum",
                                      {{"von-karman", Spectrum::von_karman}, {"kaimal", Spectrum::kaimal}},
                                      gusts.spectrum);
    gusts.rms = required(table, "rms", non_negative_number, "is missing; give the rms of the gusts in m/s");
    gusts.length =
        required(table, "length", positive_number, "is missing; give the length of the gusts in m");
    if (const auto seed = table.integer("seed", 0, std::numeric_limits<std::int64_t>::max())) {
        gusts.seed = static_cast<std::uint64_t>(*seed);
    }
    gusts.bands = static_cast<int>(table.integer("bands", 1, most_bands).value_or(gusts.bands));
    table.finish();
    return gusts;
}

WindVortex read_vortex(TomlTable& table) {
    using Core = WindVortex::Core;
    WindVortex vortex;
    vortex.type = choice<Core>(table, "kind", {{"lamb-oseen", Core::lamb_oseen}, {"rankine", Core::rankine}},
                               vortex.type);
    vortex.position = table.vector("position").value_or(vortex.position);
    vortex.axis = direction(table, "axis", table.vector("axis").value_or(vortex.axis));
    vortex.circulation = required(table, "circulation", any_number, "is missing; give it in m^2/s");
    vortex.core = required(table, "core", positive_number, "is missing; give the radius of the core in m");
    vortex.velocity = table.vector("velocity").value_or(vortex.velocity);
    table.finish();
    return vortex;
}

WindFan read_fan(TomlTable& table) {
    WindFan fan;
    fan.position = required_vector(table, "position", "is missing; give the centre of the fan in m");
    fan.direction = direction(
        table, "direction",
        required_vector(table, "direction", "is missing; give the direction of the jet as a vector"));
    fan.diameter = table.number("diameter", positive_number).value_or(fan.diameter);
    fan.speed = required(table, "speed", non_negative_number,
                         "is missing; give the speed of the air at the fan in m/s");
    table.finish();
    return fan;
}

WindFile read_file(TomlTable& table, const std::filesystem::path& folder, double end) {
    using Outside = WindFile::Outside;
    WindFile file;
    const auto path = table.text("path");
    if (!path) throw table.error("path", "is missing; give a wind file, from 'samara wind'");
    file.grid = std::make_shared<const WindGrid>(read_wind_file(folder / *path));
    file.position = table.vector("position").value_or(file.position);
    file.start = table.number("start", any_number).value_or(file.start);
    file.repeats = table.boolean("repeat").value_or(file.repeats);
    file.outside =
        choice<Outside>(table, "outside", {{"edge", Outside::edge}, {"still", Outside::still}}, file.outside);
    const bool is_steady = file.grid->frames == 1;
    const double file_end = file.start + file.grid->duration();
    if (!is_steady && !file.repeats && file_end < end * (1.0 - 1e-9)) {
        throw table.error("path", fmt::format("holds the wind until {:g} s, but the scene ends at {:g} s; "
                                              "give repeat = true, a shorter duration or a longer file",
                                              file_end, end));
    }
    table.finish();
    return file;
}

}  // namespace

Wind read_wind(TomlTable& table, const std::filesystem::path& folder, double ground, double end) {
    Wind wind;
    wind.velocity = table.vector("velocity").value_or(wind.velocity);
    if (auto profile = table.table("profile")) {
        wind.profile = read_profile(*profile, ground);
        if (wind.velocity.isZero(0.0)) {
            throw table.error("velocity", "is missing; a profile needs a velocity");
        }
        if (wind.velocity.z() != 0.0) {
            throw table.error("velocity", "must be horizontal (z = 0) if it has a profile");
        }
    }
    if (auto layer = table.table("surface_layer")) wind.surface_layer = read_surface_layer(*layer);
    if (auto gusts = table.table("gusts")) wind.gusts = read_gusts(*gusts);
    for (TomlTable& vortex : table.tables("vortex")) wind.vortices.push_back(read_vortex(vortex));
    for (TomlTable& fan : table.tables("fan")) wind.fans.push_back(read_fan(fan));
    if (auto file = table.table("file")) wind.file = read_file(*file, folder, end);
    table.finish();
    return wind;
}

}  // namespace samara

// The one function of the C interface that reads TOML, which the core does without.
samara_status samara_set_wind(samara_simulation* simulation, const char* wind, char* error,
                              size_t error_size) {
    return samara::guarded(error, error_size, [&] {
        samara::require(simulation, "simulation");
        samara::require(wind, "wind");
        samara::Simulation& core = simulation->core;
        core.require_running();
        const toml::table document = samara::parse_toml(wind, "wind");
        samara::TomlTable table(document, "wind", "the wind");
        const std::lock_guard lock(samara::hdf5_mutex());  // of a wind file
        // A wind file need not last as long as a simulation, which has no end of its own.
        constexpr double no_end = -std::numeric_limits<double>::infinity();
        samara::Wind given = samara::read_wind(table, ".", core.ground().value_or(0.0), no_end);
        given.function = core.wind().function;
        given.function_context = core.wind().function_context;
        core.set_wind(given);
    });
}
