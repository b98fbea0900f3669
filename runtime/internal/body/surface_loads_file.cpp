#include "internal/body/surface_loads_file.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "internal/files/row_major.hpp"
#include "samara/base/error.hpp"

namespace samara {
namespace {

constexpr const char* group = "/surface_loads";
constexpr const char* force_name = "/surface_loads/force";
constexpr const char* moment_name = "/surface_loads/moment";
constexpr const char* friction_force_name = "/surface_loads/friction_force";
constexpr const char* friction_moment_name = "/surface_loads/friction_moment";
constexpr std::int64_t most_subdivisions = 1024;
constexpr double most_coefficient = 1e3;

void write_vectors(Hdf5Writer& file, const char* name, const SurfaceLoads& loads,
                   Vector3d PressureLoads::*part, const char* meaning) {
    std::vector<double> values;
    for (const PressureLoads& load : loads.pressure) {
        for (int i = 0; i < 3; ++i) values.push_back((load.*part)[i]);
    }
    const auto size = static_cast<hsize_t>(2 * loads.subdivisions + 1);
    file.write(name, values, {size, size, 3}, "1", meaning);
}

void read_vectors(const Hdf5Reader& file, const char* name, Vector3d PressureLoads::*part,
                  SurfaceLoads& loads) {
    const auto size = static_cast<hsize_t>(2 * loads.subdivisions + 1);
    const std::vector<double> values = file.finite_doubles(name, {size, size, 3});
    loads.pressure.resize(values.size() / 3);
    for (std::size_t i = 0; i < loads.pressure.size(); ++i) {
        loads.pressure[i].*part = Vector3d(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    }
}

double largest_of(const SurfaceLoads& loads) {
    double largest =
        std::max(loads.friction_force.cwiseAbs().maxCoeff(), loads.friction_moment.cwiseAbs().maxCoeff());
    for (const PressureLoads& load : loads.pressure) {
        largest = std::max({largest, load.force.cwiseAbs().maxCoeff(), load.moment.cwiseAbs().maxCoeff()});
    }
    return largest;
}

}  // namespace

void write_surface_loads(Hdf5Writer& file, const SurfaceLoads& loads) {
    write_vectors(file, force_name, loads, &PressureLoads::force,
                  "F / (rho U^2 A / 2) of the pressure, body axes");
    write_vectors(file, moment_name, loads, &PressureLoads::moment,
                  "M / (rho U^2 A L / 2) of the pressure about the centroid of the volume, body axes");
    file.write(friction_force_name, row_major(loads.friction_force), {3, 3}, "1",
               "times direction and friction coefficient: F / (rho U^2 A / 2)");
    file.write(friction_moment_name, row_major(loads.friction_moment), {3, 3}, "1",
               "times direction and friction coefficient: M / (rho U^2 A L / 2)");
    file.attribute(group, "subdivisions", std::int64_t{loads.subdivisions});
}

SurfaceLoads read_surface_loads(const Hdf5Reader& file) {
    const auto fault = [&](const std::string& what) {
        return Error(fmt::format("{}: {} {}; make it again with 'samara kirchhoff'", file.path().string(),
                                 group, what));
    };
    const std::int64_t subdivisions = file.integer_attribute(group, "subdivisions");
    if (subdivisions < 1 || subdivisions > most_subdivisions) throw fault("has a map of no sane size");
    SurfaceLoads loads;
    loads.subdivisions = static_cast<int>(subdivisions);
    read_vectors(file, force_name, &PressureLoads::force, loads);
    read_vectors(file, moment_name, &PressureLoads::moment, loads);
    loads.friction_force = from_row_major<Matrix3d>(file.finite_doubles(friction_force_name, {3, 3}));
    loads.friction_moment = from_row_major<Matrix3d>(file.finite_doubles(friction_moment_name, {3, 3}));
    if (const double largest = largest_of(loads); largest > most_coefficient) {
        throw fault(fmt::format("holds a coefficient of {:g}", largest));
    }
    return loads;
}

}  // namespace samara
