#include "samara/core/body/body_file_groups.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/body/file_arrays.hpp"

namespace samara {
namespace {

constexpr const char* coefficients_group = "/dynamic_coefficients";
constexpr const char* lowest_density = "lowest_density";
constexpr const char* highest_density = "highest_density";
/// Tensors of earlier forms: an angular momentum that the wake carried along, and fluid that rotated with the
/// body.
constexpr const char* former_tensors[] = {"wake_by_velocity", "wake_by_turning", "entrained_inertia"};

std::string place(const char* name, const char* name_end = "") {
    return fmt::format("{}/{}{}", coefficients_group, name, name_end);
}

Matrix3d read_tensor(const Hdf5Reader& file, const char* name, const char* name_end) {
    return from_row_major<Matrix3d>(file.finite_doubles(place(name, name_end), {3, 3}));
}

/// Reads the numbers that values and standard errors have in common.
DynamicCoefficients read_numbers(const Hdf5Reader& file, const char* name_end) {
    DynamicCoefficients numbers;
    for (const NumberOfMotion& number : numbers_of_motion) {
        std::string name = fmt::format("{}{}", number.name, name_end);
        if (const std::string older = fmt::format("{}{}", number.older_name, name_end);
            *number.older_name != '\0' && file.has_attribute(coefficients_group, older)) {
            name = older;
        }
        if (number.is_late && !file.has_attribute(coefficients_group, name)) {
            if (*name_end != '\0') numbers.*number.member = 0.0;
        } else {
            numbers.*number.member = file.number_attribute(coefficients_group, name);
        }
    }
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        numbers.*tensor.member = read_tensor(file, tensor.name, name_end);
    }
    return numbers;
}

void write_numbers(Hdf5Writer& file, const DynamicCoefficients& numbers, const char* name_end) {
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        const bool is_value = *name_end == '\0';
        file.write(place(tensor.name, name_end), row_major(numbers.*tensor.member), {3, 3}, tensor.unit,
                   is_value ? tensor.meaning : "standard error of the tensor of the same name");
    }
    for (const NumberOfMotion& number : numbers_of_motion) {
        file.attribute(coefficients_group, fmt::format("{}{}", number.name, name_end),
                       numbers.*number.member);
    }
}

/// Reads the densities of the falls; older files lack them.
IdentifiedDensities read_densities(const Hdf5Reader& file) {
    if (!file.has_attribute(coefficients_group, lowest_density) &&
        !file.has_attribute(coefficients_group, highest_density))
        return {};
    return {file.number_attribute(coefficients_group, lowest_density),
            file.number_attribute(coefficients_group, highest_density)};
}

bool are_sound(const IdentifiedDensities& densities) {
    const auto& [lowest, highest] = densities;
    return (lowest == 0.0 && highest == 0.0) || (lowest > 0.0 && lowest <= highest && std::isfinite(highest));
}

/// Returns what is wrong with a standard error; empty where nothing is.
std::string error_of_errors(const DynamicCoefficients& errors) {
    for (const NumberOfMotion& number : numbers_of_motion) {
        const double error = errors.*number.member;
        if (!(error >= 0.0) || !std::isfinite(error)) return std::string(number.name) + "_error";
    }
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        if ((errors.*tensor.member).minCoeff() < 0.0) return std::string(tensor.name) + "_error";
    }
    return {};
}

/// Returns whether the coefficients hold terms that simulations no longer have.
bool is_of_an_earlier_form(const Hdf5Reader& file) {
    if (file.has_attribute(coefficients_group, "force_transport")) return true;
    return std::any_of(std::begin(former_tensors), std::end(former_tensors), [&file](const char* name) {
        return file.has(place(name)) && !read_tensor(file, name, "").isZero(0.0);
    });
}

}  // namespace

void write_dynamic_coefficients(Hdf5Writer& file, const IdentifiedCoefficients& coefficients) {
    write_numbers(file, coefficients.values, "");
    write_numbers(file, coefficients.standard_errors, "_error");
    file.attribute(coefficients_group, "half_length", coefficients.values.half_length);
    if (coefficients.densities.lowest > 0.0) {
        file.attribute(coefficients_group, lowest_density, coefficients.densities.lowest);
        file.attribute(coefficients_group, highest_density, coefficients.densities.highest);
    }
    file.attribute(coefficients_group, "origin", std::string_view(coefficients.values.origin));
}

IdentifiedCoefficients read_dynamic_coefficients(const Hdf5Reader& file) {
    if (is_of_an_earlier_form(file)) {
        throw Error(
            fmt::format("{}: {} has an outdated form, which this version cannot simulate; bake the body "
                        "again, or remove the group to use the defaults",
                        file.path().string(), coefficients_group));
    }
    IdentifiedCoefficients coefficients{.values = read_numbers(file, ""),
                                        .standard_errors = read_numbers(file, "_error"),
                                        .densities = read_densities(file)};
    coefficients.values.half_length = file.number_attribute(coefficients_group, "half_length");
    coefficients.values.origin = file.text_attribute(coefficients_group, "origin");
    const auto reject = [&](const std::string& what) {
        throw Error(fmt::format("{}: {}/{}; correct it, or remove the group to use the defaults",
                                file.path().string(), coefficients_group, what));
    };
    if (const std::string error = error_of(coefficients.values); !error.empty()) reject(error);
    if (const std::string name = error_of_errors(coefficients.standard_errors); !name.empty()) {
        reject(name + " is not a standard error: negative or not finite");
    }
    if (!are_sound(coefficients.densities)) {
        reject("lowest_density and highest_density are not two positive numbers in ascending order");
    }
    return coefficients;
}

void write_mass(Hdf5Writer& file, const MassSpecification& mass) {
    if (mass.density) file.write("/mass/density", std::vector{*mass.density}, {1}, "kg/m^3", "uniform");
    if (mass.mass) file.write("/mass/mass", std::vector{*mass.mass}, {1}, "kg", "the whole");
    if (mass.area_density) {
        file.write("/mass/area_density", std::vector{*mass.area_density}, {1}, "kg/m^2",
                   "of half the surface; copies of other sizes keep the thickness");
    }
    if (mass.center_of_mass) {
        file.write("/mass/center_of_mass", row_major(*mass.center_of_mass), {3}, "m", "shape axes");
    }
    if (mass.inertia) {
        file.write("/mass/inertia", row_major(*mass.inertia), {3, 3}, "kg m^2",
                   "about the centre of mass, shape axes");
    }
}

MassSpecification read_mass(const Hdf5Reader& file) {
    MassSpecification mass;
    if (file.has("/mass/density")) mass.density = file.finite_doubles("/mass/density", {1}).front();
    if (file.has("/mass/mass")) mass.mass = file.finite_doubles("/mass/mass", {1}).front();
    if (file.has("/mass/area_density")) {
        mass.area_density = file.finite_doubles("/mass/area_density", {1}).front();
    }
    if (mass.given() != 1) {
        throw Error(
            fmt::format("{}: /mass must hold one of density, mass and area_density; make the file again",
                        file.path().string()));
    }
    if (file.has("/mass/center_of_mass")) {
        mass.center_of_mass = from_row_major<Vector3d>(file.finite_doubles("/mass/center_of_mass", {3}));
    }
    if (file.has("/mass/inertia")) {
        mass.inertia = from_row_major<Matrix3d>(file.finite_doubles("/mass/inertia", {3, 3}));
    }
    return mass;
}

namespace {

constexpr const char* recommended_group = "/recommended";

/// Returns the text's place among the names; throws Error, naming the attribute, where it is none of them.
template <std::size_t count>
std::size_t named(const Hdf5Reader& file, const char* attribute,
                  const std::array<const char*, count>& names) {
    const std::string text = file.text_attribute(recommended_group, attribute);
    const auto found = std::find(names.begin(), names.end(), text);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    throw Error(fmt::format("{}: {} has {} \"{}\"; choose it again with 'samara recommend'",
                            file.path().string(), recommended_group, attribute, text));
}

}  // namespace

void write_recommended_models(Hdf5Writer& file, const RecommendedModels& models) {
    file.attribute(recommended_group, "loads", std::string_view(name_of(models.loads)));
    file.attribute(recommended_group, "patches", std::int64_t{models.patches});
    file.attribute(recommended_group, "turbulence", std::string_view(name_of(models.turbulence)));
    file.attribute(recommended_group, "origin", std::string_view(models.origin));
}

RecommendedModels read_recommended_models(const Hdf5Reader& file) {
    RecommendedModels models;
    models.loads = static_cast<Loads>(named(file, "loads", names_of_loads));
    models.turbulence = static_cast<Turbulence>(named(file, "turbulence", names_of_turbulence));
    models.patches = static_cast<int>(
        std::clamp<std::int64_t>(file.integer_attribute(recommended_group, "patches"), 0, 1000));
    models.origin = file.text_attribute(recommended_group, "origin");
    return models;
}

namespace {

constexpr const char* region_name = "/tables/planned";
constexpr const char* report_name = "/tables/plan";

}  // namespace

void write_planned_region(Hdf5Writer& file, const PlannedRegion& region) {
    if (!region.report.empty()) {
        file.write_text(report_name, region.report, "JSON: what a bake for a scene aimed at and reached");
    }
    if (region.subdivisions == 0) return;
    const hsize_t side = 2 * static_cast<hsize_t>(region.subdivisions) + 1;
    const std::vector<std::int32_t> planned(region.planned.begin(), region.planned.end());
    file.write(region_name, planned, {side, side}, "1",
               "1 where the scene's motion was expected: nodes of an octahedral map of the tables' axes");
}

PlannedRegion read_planned_region(const Hdf5Reader& file) {
    PlannedRegion region;
    if (file.has(report_name)) region.report = file.json_text(report_name);
    if (!file.has(region_name)) return region;
    const std::vector<std::int32_t> planned = file.integers(region_name, {0, 0});
    const auto side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(planned.size()))));
    region.subdivisions = (side - 1) / 2;
    if (region.subdivisions < 1 ||
        planned.size() != static_cast<std::size_t>(side) * static_cast<std::size_t>(side) || side % 2 == 0) {
        throw Error(fmt::format("{}: {} is not a map of directions; bake the body again",
                                file.path().string(), region_name));
    }
    for (const std::int32_t one : planned) region.planned.push_back(one != 0 ? 1 : 0);
    return region;
}

namespace {

constexpr const char* surface_group = "/surface_loads";
constexpr const char* potentials_name = "/surface_loads/potentials";
// No surface of the area pi L^2 is as wide, and no potential of a unit velocity as large.
constexpr double most_lengths = 1e4;

double largest_of(const std::vector<Vector3d>& vectors) {
    double largest = 0.0;
    for (const Vector3d& vector : vectors) largest = std::max(largest, vector.cwiseAbs().maxCoeff());
    return largest;
}

}  // namespace

void write_surface_loads(Hdf5Writer& file, const SurfaceLoads& loads) {
    write_surface(file, surface_group, loads.surface, "1",
                  "over L about the centroid of the volume, body axes");
    file.write(potentials_name, flattened(loads.potentials), {loads.potentials.size(), 3}, "1",
               "at each vertex, over U L: the fluid's potentials where the body moves along each axis");
}

bool has_surface_loads(const Hdf5Reader& file) {
    return file.has(potentials_name);
}

SurfaceLoads read_surface_loads(const Hdf5Reader& file) {
    SurfaceLoads loads;
    loads.surface = read_surface(file, surface_group);
    loads.surface.edge_nodes.clear();
    loads.potentials = unflattened(file.finite_doubles(potentials_name, {loads.surface.vertices.size(), 3}));
    const double largest = std::max(largest_of(loads.surface.vertices), largest_of(loads.potentials));
    if (largest > most_lengths) {
        throw Error(fmt::format("{}: {} holds a length of {:g} L; make it again with 'samara kirchhoff'",
                                file.path().string(), surface_group, largest));
    }
    return loads;
}

namespace {

constexpr const char* sources_name = "/tables/error_sources";
constexpr const char* left_out_name = "/tables/left_out";

Error error(const Hdf5Reader& file, const std::string& what) {
    return Error(fmt::format("{}: {}; bake the body again", file.path().string(), what));
}

std::vector<ErrorSource> sources_of(const Hdf5Reader& file) {
    const std::string names = file.text_attribute("/tables", "error_sources");
    std::vector<ErrorSource> sources;
    for (std::size_t start = 0; start < names.size();) {
        const std::size_t end = std::min(names.find(' ', start), names.size());
        const std::string name = names.substr(start, end - start);
        const auto source = error_source(name);
        if (!source) throw error(file, fmt::format("/tables names the unknown error source '{}'", name));
        sources.push_back(*source);
        start = end + 1;
    }
    return sources;
}

}  // namespace

void write_table_errors(Hdf5Writer& file, const LoadTables& tables) {
    if (!tables.error_sources.empty()) {
        std::vector<double> values;
        std::vector<std::string_view> names;
        for (const ErrorShare& share : tables.error_sources) {
            values.insert(values.end(), {share.force, share.moment, share.turbulent_kinetic_energy,
                                         share.dissipation_rate});
            names.emplace_back(name_of(share.source));
        }
        file.write(sources_name, values, {tables.error_sources.size(), 4}, "1",
                   "root mean square standard error by source over that of force, moment, turbulent kinetic "
                   "energy and dissipation rate");
        const std::string joined = fmt::format("{}", fmt::join(names, " "));
        file.attribute("/tables", "error_sources", std::string_view(joined));
    }
    if (!tables.left_out.empty()) {
        file.write_text(left_out_name, tables.left_out,
                        "JSON: cases that could not be solved, whose directions are filled from the others");
    }
}

void read_table_errors(const Hdf5Reader& file, LoadTables& tables) {
    if (file.has(sources_name)) {
        const std::vector<ErrorSource> sources = sources_of(file);
        const std::vector<double> values = file.finite_doubles(sources_name, {sources.size(), 4});
        for (std::size_t i = 0; i < sources.size(); ++i) {
            const double* row = &values[4 * i];
            tables.error_sources.push_back({sources[i], row[0], row[1], row[2], row[3]});
        }
    }
    if (file.has(left_out_name)) tables.left_out = file.json_text(left_out_name);
}

}  // namespace samara
