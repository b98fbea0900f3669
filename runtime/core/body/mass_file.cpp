#include "samara/core/body/mass_file.hpp"

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/files/row_major.hpp"

namespace samara {

void write_mass(Hdf5Writer& file, const MassSpecification& mass) {
    if (mass.density) file.write("/mass/density", std::vector{*mass.density}, {1}, "kg/m^3", "uniform");
    if (mass.mass) file.write("/mass/mass", std::vector{*mass.mass}, {1}, "kg", "the whole");
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
    if (mass.density.has_value() == mass.mass.has_value()) {
        throw Error(fmt::format("{}: /mass must hold a density or a mass, and not both; make the file again",
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

}  // namespace samara
