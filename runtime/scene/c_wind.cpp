// samara_set_wind: the one function of the C interface that reads TOML, which the core does without.
#include <limits>
#include <mutex>

#include "samara.h"
#include "samara/core/c_interface/guard.hpp"
#include "samara/core/c_interface/objects.hpp"
#include "samara/formats/toml_table.hpp"
#include "samara/scene/wind_table.hpp"

namespace {

using samara::guarded;
using samara::require;

// Of a simulation, for wind files: they need not last.
constexpr double no_end = -std::numeric_limits<double>::infinity();

}  // namespace

samara_status samara_set_wind(samara_simulation* simulation, const char* wind, char* error,
                              size_t error_size) {
    return guarded(error, error_size, [&] {
        require(simulation, "simulation");
        require(wind, "wind");
        samara::Simulation& core = simulation->core;
        core.require_running();
        const toml::table document = samara::parse_toml(wind, "wind");
        samara::TomlTable table(document, "wind", "the wind");
        const std::lock_guard lock(samara::hdf5_mutex());  // of a wind file
        samara::Wind given = samara::read_wind(table, ".", core.ground().value_or(0.0), no_end);
        given.function = core.wind().function;
        given.function_context = core.wind().function_context;
        core.set_wind(given);
    });
}
