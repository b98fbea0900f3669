#include "samara/scene/scene_file.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/text.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/input_file.hpp"
#include "samara/core/surface/surface_patches.hpp"
#include "samara/formats/display_mesh_file.hpp"
#include "samara/formats/toml_table.hpp"
#include "samara/scene/obstacle_table.hpp"
#include "samara/scene/ready_bodies.hpp"
#include "samara/scene/require_rules.hpp"
#include "samara/scene/wind_table.hpp"

namespace samara {
namespace {

constexpr std::size_t most_bytes_of_a_scene = 64'000'000;  // devices have no end

/// Copies a value that the file gives; leaves the default where it does not.
template <typename Value>
void assign(Value& target, const std::optional<Value>& given) {
    if (given) target = *given;
}

Fluid read_fluid(TomlTable& table) {
    const auto preset = table.text("preset");
    const auto density = table.number("density");
    const auto viscosity = table.number("viscosity");
    if (preset && (density || viscosity)) {
        throw table.error("preset", "excludes density and viscosity; give the preset or both of these");
    }
    if (density.has_value() != viscosity.has_value()) {
        throw table.error(density ? "density" : "viscosity",
                          "is not enough; give density and viscosity, or a preset");
    }
    Fluid fluid = *fluid_preset("water");
    if (preset) {
        const auto known = fluid_preset(*preset);
        if (!known) throw table.error("preset", R"(must be "water" or "air")");
        fluid = *known;
    }
    assign(fluid.density, density);
    assign(fluid.viscosity, viscosity);
    assign(fluid.current, table.vector("current"));
    if (auto gust = table.table("gust")) {
        const auto amplitude = gust->vector("amplitude");
        const auto period = gust->number("period");
        if (!amplitude || !period) {
            throw gust->error(amplitude ? "period" : "amplitude",
                              "is missing; a gust has an amplitude and a period");
        }
        fluid.gust = {.amplitude = *amplitude, .period = *period};
        gust->finish();
    }
    table.finish();
    return fluid;
}

/// Three moments of inertia about the axes, or the whole symmetric matrix as three rows.
std::optional<Matrix3d> read_inertia(TomlTable& table) {
    const toml::node* node = table.node("inertia");
    if (node == nullptr) return std::nullopt;
    const toml::array* rows = node->as_array();
    if (rows != nullptr && rows->size() == 3 && rows->is_homogeneous(toml::node_type::array)) {
        Matrix3d inertia;
        for (std::size_t row = 0; row < 3; ++row) {
            const toml::array& values = *rows->get(row)->as_array();
            if (values.size() != 3) throw table.error("inertia", "must be three rows of three numbers");
            for (std::size_t column = 0; column < 3; ++column) {
                const auto value = values.get(column)->value<double>();
                if (!value || !(std::abs(*value) <= largest_number)) {
                    throw table.error("inertia", "must hold finite numbers, 1e30 at most");
                }
                inertia(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = *value;
            }
        }
        return inertia;
    }
    const auto moments = table.vector("inertia");
    return Matrix3d(moments->asDiagonal());
}

MassSpecification read_mass(TomlTable& table) {
    MassSpecification mass;
    mass.density = table.number("density");
    mass.mass = table.number("mass");
    if (const auto grams = table.number("area_density")) mass.area_density = gram * *grams;
    mass.center_of_mass = table.vector("center_of_mass");
    mass.inertia = read_inertia(table);
    require_rules(table, broken_rule(mass));
    return mass;
}

/// What the equations hold, beside turbulence and coefficients.
void read_models(TomlTable& table, SceneBody& body) {
    body.loads = choice<Loads>(table, "loads",
                               {{"none", Loads::none},
                                {"coefficients", Loads::coefficients},
                                {"table", Loads::table},
                                {"surface", Loads::surface}},
                               body.loads);
    body.open.loads = table.node("loads") == nullptr;
    assign(body.added_mass, table.boolean("added_mass"));
    body.dynamic = choice<Dynamic>(
        table, "dynamic_coefficients",
        {{"body", Dynamic::of_body}, {"default", Dynamic::by_default}, {"none", Dynamic::none}},
        body.dynamic);
    body.table_reynolds_number = table.number("table_reynolds_number");
    if (const auto patches = table.integer("patches", 1, most_surface_patches)) {
        if (body.loads == Loads::none)
            throw table.error("patches", "applies to loads, but loads = \"none\"; remove it or change loads");
        body.patches = static_cast<int>(*patches);
    }
    body.open.patches = table.node("patches") == nullptr;
    body.models_auto = choice<bool>(table, "models", {{"auto", true}, {"given", false}}, false);
    if (!body.models_auto) return;
    for (const char* key :
         {"loads", "added_mass", "dynamic_coefficients", "table_reynolds_number", "turbulence"}) {
        if (table.node(key) == nullptr) continue;
        throw table.error(key, R"(is chosen by models = "auto"; give one of the two)");
    }
}

CoefficientLoads read_coefficients(TomlTable& table, Loads loads) {
    CoefficientLoads coefficients;
    for (const char* key :
         {"drag_coefficient", "lift_coefficient", "reference_area", "normal", "center_of_pressure"}) {
        if (table.node(key) != nullptr && loads != Loads::coefficients) {
            throw table.error(key, R"(applies only to loads = "coefficients"; remove it or change loads)");
        }
    }
    assign(coefficients.drag_coefficient, table.number("drag_coefficient"));
    assign(coefficients.lift_coefficient, table.number("lift_coefficient"));
    coefficients.reference_area = table.number("reference_area");
    coefficients.normal = table.vector("normal");
    assign(coefficients.center_of_pressure, table.vector("center_of_pressure"));
    return coefficients;
}

void read_turbulence(TomlTable& table, SceneBody& body) {
    body.turbulence = usual_turbulence(body.loads);
    body.turbulence = choice<Turbulence>(
        table, "turbulence",
        {{"none", Turbulence::none}, {"constant", Turbulence::constant}, {"table", Turbulence::table}},
        body.turbulence);
    body.langevin = choice<Langevin>(table, "langevin",
                                     {{"wake", Langevin::wake},
                                      {"seen-fluid", Langevin::sampled_turbulence},
                                      {"body-velocity", Langevin::body_velocity}},
                                     body.langevin);
    body.open.turbulence = table.node("turbulence") == nullptr;
    const auto energy = table.number("turbulent_kinetic_energy");
    const auto dissipation = table.number("dissipation_rate");
    const bool constant = body.turbulence == Turbulence::constant;
    if (constant != energy.has_value() || constant != dissipation.has_value()) {
        throw table.error("turbulence", constant
                                            ? "needs turbulent_kinetic_energy and dissipation_rate; give both"
                                            : R"(must be "constant" if its values are given)");
    }
    assign(body.turbulent_kinetic_energy, energy);
    assign(body.dissipation_rate, dissipation);
}

void read_start(TomlTable& table, const std::filesystem::path& folder, SceneBody& body) {
    const auto position = table.vector("position");
    assign(body.position, position);
    if (auto emitter = table.table("emitter")) {
        if (position) {
            throw table.error("position",
                              "excludes emitter, which defines where bodies start; give one of the two");
        }
        body.emitter = std::make_shared<const Emitter>(read_emitter(*emitter, folder));
    }
    assign(body.orientation, table.orientation());
    assign(body.velocity, table.vector("velocity"));
    assign(body.angular_velocity, table.vector("angular_velocity"));
    assign(body.start, table.number("start"));
    if (const auto count = table.integer("count", 1, most_copies)) body.count = static_cast<int>(*count);
    if (auto spread = table.table("spread")) {
        assign(body.spread_position, spread->vector("position"));
        assign(body.spread_angle, spread->number("angle"));
        assign(body.spread_start, spread->number("start"));
        if (const auto sizes = spread->numbers("size", 2)) {
            body.smallest_size = (*sizes)[0];
            body.largest_size = (*sizes)[1];
        }
        spread->finish();
    }
    require_rules(table, broken_rule(static_cast<const Release&>(body)));
}

/// The file that `shape` names: a ready-baked body, or a file seen from the scene's folder.
std::filesystem::path shape_file(const TomlTable& table, const std::string& shape,
                                 const std::filesystem::path& folder) {
    if (shape.starts_with(ready_body_prefix)) {
        try {
            return ready_body_file(shape.substr(ready_body_prefix.size()));
        } catch (const Error& error) {
            throw table.error("shape", fmt::format("cannot be read: {}", error.what()));
        }
    }
    const std::filesystem::path file = folder / shape;  // an absolute path stays as it is
    if (const std::string error = reading_error(file); !error.empty()) {
        throw table.error("shape", fmt::format("cannot be read: {}: {}", file.string(), error));
    }
    return file;
}

/// What exports show of a body; null where the scene says nothing.
std::shared_ptr<const DisplayMesh> read_display(TomlTable& table, const std::filesystem::path& folder,
                                                double shape_scale) {
    const auto name = table.text("look");
    const auto scale = table.number("look_scale", positive_number);
    if (!name) {
        if (scale) throw table.error("look_scale", "needs a look; give one, or remove it");
        return nullptr;
    }
    const std::filesystem::path file = folder / *name;
    if (const std::string error = reading_error(file); !error.empty()) {
        throw table.error("look", fmt::format("cannot be read: {}: {}", file.string(), error));
    }
    try {
        DisplayMesh display = read_display_mesh_file(file);
        for (Vector3d& place : display.positions) place *= scale.value_or(shape_scale);
        return std::make_shared<const DisplayMesh>(std::move(display));
    } catch (const Error& error) {
        throw table.error("look", fmt::format("cannot be read: {}", error.what()));
    }
}

/// Gives a body of a file another size. What the scene says of its mass and its axes is of that size.
void scale_body(const TomlTable& table, double scale, SceneBody& body) {
    if (scale == 1.0) return;
    body.smallest_size *= scale;
    body.largest_size *= scale;
    if (const auto broken = broken_rule(static_cast<const Release&>(body))) {
        throw table.error("scale", "times spread.size must lie within 0.001 and 1000");
    }
    const double area = scale * scale;
    if (body.mass.mass) *body.mass.mass /= area * scale;
    if (body.mass.center_of_mass) *body.mass.center_of_mass /= scale;
    if (body.mass.inertia) *body.mass.inertia /= area * area * scale;
    if (body.coefficients.reference_area) *body.coefficients.reference_area /= area;
    body.coefficients.center_of_pressure /= scale;
}

SceneBody read_body(TomlTable& table, const std::filesystem::path& folder) {
    SceneBody body;
    const auto name = table.text("name");
    if (!name) throw table.error("name", "is missing; give the body a name");
    if (!is_plain_name(*name)) throw table.error("name", plain_name_words);
    body.name = *name;
    const auto shape = table.text("shape");
    if (!shape)
        throw table.error(
            "shape",
            "is missing; give a shape file, a .body.h5 or a ready-baked body, such as \"samara:leaf\"");
    body.shape = shape_file(table, *shape, folder);
    const double scale = table.number("scale", positive_number).value_or(1.0);
    const bool is_made = is_body_file_name(body.shape);
    if (!is_made) body.scale = scale;
    assign(body.thickness, table.number("thickness", positive_number));
    if (is_made && body.thickness > 0.0) {
        throw table.error("thickness",
                          "applies to the open sheet of a shape file, but this is a body file; remove it");
    }
    body.display = read_display(table, folder, scale);
    body.mass = read_mass(table);
    if (!body.mass.is_given() && !is_made) {
        throw table.error("density", "is missing; give density, mass or area_density");
    }
    read_start(table, folder, body);
    read_models(table, body);
    body.coefficients = read_coefficients(table, body.loads);
    read_turbulence(table, body);
    if (is_made) scale_body(table, scale, body);
    require_rules(table, broken_rule(static_cast<const BodyPhysics&>(body)));
    if (body.coefficients.normal) body.coefficients.normal->normalize();
    table.finish();
    return body;
}

void read_step(TomlTable& table, Scene& scene) {
    const toml::node* step = table.node("step");
    scene.step_auto = step != nullptr && step->is_string();
    if (!scene.step_auto) {
        assign(scene.step, table.number("step", positive_number));
    } else if (*table.text("step") != "auto") {
        throw table.error("step", "must be a number of seconds, or \"auto\"");
    }
    const auto tolerance = table.number(
        "step_tolerance", {1e-6, 0.1, "must lie between 1e-6 and 0.1, relative to the distance moved"});
    if (tolerance && !scene.step_auto) {
        throw table.error("step_tolerance",
                          "applies only to step = \"auto\"; remove it, or set step = \"auto\"");
    }
    assign(scene.step_tolerance, tolerance);
}

void read_settings(TomlTable& table, Scene& scene) {
    const auto duration = table.number("duration", positive_number);
    if (!duration) throw table.error("duration", "is missing; give the time to simulate in seconds");
    scene.duration = *duration;
    read_step(table, scene);
    assign(scene.frame_rate, table.number("frame_rate", positive_number));
    if (const auto seed = table.integer("seed", 0, std::numeric_limits<std::int64_t>::max())) {
        scene.seed = static_cast<std::uint64_t>(*seed);
    }
    assign(scene.gravity, table.vector("gravity"));
    scene.ground = table.number("ground");
    assign(scene.bodies_collide, table.boolean("bodies_meet"));  // its name in older scenes
    assign(scene.bodies_collide, table.boolean("bodies_collide"));
    scene.precision = choice(
        table, "precision",
        Words<Precision>{{"double", Precision::double_precision}, {"single", Precision::single_precision}},
        scene.precision);
    require_rules(table, broken_rule(scene.precision, scene.bodies_collide));
    if (scene.duration * scene.frame_rate > 1e8 || scene.duration / scene.step > 1e10) {
        throw table.error("duration", "gives more than 1e8 frames or 1e10 steps; check the units");
    }
    table.finish();
}

toml::table parsed_scene(const Scene& scene) {
    const std::string file = scene.file.string();
    try {
        return parse_toml(scene.text, file);
    } catch (const Error& error) {
        const std::filesystem::path ending = scene.file.extension();
        if (ending.empty() || ending == ".toml") throw;
        throw Error(fmt::format("{}; give a scene file (.toml)", error.what()));
    }
}

}  // namespace

Scene read_scene_file(const std::filesystem::path& file) {
    return read_scene_text(read_at_most(file, most_bytes_of_a_scene), file.string(),
                           file.has_parent_path() ? file.parent_path() : ".");
}

Scene read_scene_text(std::string text, const std::string& name, const std::filesystem::path& folder) {
    Scene scene;
    scene.file = name;
    scene.text = std::move(text);
    const toml::table document = parsed_scene(scene);
    TomlTable top(document, name, "the scene");
    auto settings = top.table("scene");
    if (!settings) throw top.error("[scene]", "is missing; give it with at least the duration");
    read_settings(*settings, scene);
    if (auto fluid = top.table("fluid")) scene.fluid = read_fluid(*fluid);
    require_rules(top, broken_rule(scene.fluid));
    if (auto wind = top.table("wind"))
        scene.wind = read_wind(*wind, folder, scene.ground.value_or(0.0), scene.duration);
    std::set<std::string> names;
    for (TomlTable& table : top.tables("body")) {
        scene.bodies.push_back(read_body(table, folder));
        if (!names.insert(scene.bodies.back().name).second) {
            throw table.error("name", fmt::format("is '{}', as of another body; choose another name",
                                                  scene.bodies.back().name));
        }
    }
    std::set<std::string> obstacle_names;
    for (TomlTable& table : top.tables("obstacle")) {
        scene.obstacles.push_back(read_obstacle(table, folder));
        const std::string& obstacle = scene.obstacles.back().name;
        if (obstacle_names.insert(obstacle).second) continue;
        throw table.error("name",
                          fmt::format("is '{}', as of another obstacle; choose another name", obstacle));
    }
    top.finish();
    if (scene.bodies.empty()) throw Error(fmt::format("{}: has no [[body]]; add one", name));
    return scene;
}

}  // namespace samara
