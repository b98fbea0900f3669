// samara mass: what a body weighs where a scene does not say.

#include <optional>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "samara/commands/body_report.hpp"
#include "samara/commands/commands.hpp"
#include "samara/commands/option_values.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_check.hpp"
#include "samara/core/body/body_file.hpp"

namespace samara {
namespace {

struct Request {
    std::string file;
    std::string output;
    std::optional<double> density;
    std::optional<double> mass;
    std::optional<double> area_density;
    std::string center_of_mass;
    std::string inertia;
};

Vector3d vector_option(const char* option, const std::string& words, const char* example) {
    if (const auto vector = vector_of_words(words)) return *vector;
    throw Error(fmt::format("{}: '{}' is not a vector; give x,y,z, such as {}", option, words, example));
}

/// Returns the inertia of moments xx,yy,zz, which products xy,xz,yz may follow.
Matrix3d inertia_option(const std::string& words) {
    std::string products = "0,0,0";
    std::string moments = words;
    std::size_t comma = 0;
    for (int i = 0; i < 3 && comma != std::string::npos; ++i) comma = words.find(',', i == 0 ? 0 : comma + 1);
    if (comma != std::string::npos) {
        moments = words.substr(0, comma);
        products = words.substr(comma + 1);
    }
    constexpr const char* example = "6.8e-10,1.07e-8,1.12e-8";
    Matrix3d inertia = vector_option("--inertia", moments, example).asDiagonal();
    const Vector3d product = vector_option("--inertia", products, "0,-1.7e-8,0 after the moments");
    inertia(0, 1) = inertia(1, 0) = product.x();
    inertia(0, 2) = inertia(2, 0) = product.y();
    inertia(1, 2) = inertia(2, 1) = product.z();
    return inertia;
}

MassSpecification asked(const Request& request) {
    MassSpecification mass;
    mass.density = request.density;
    mass.mass = request.mass;
    if (request.area_density) mass.area_density = gram * *request.area_density;
    if (!request.center_of_mass.empty()) {
        mass.center_of_mass = vector_option("--center-of-mass", request.center_of_mass, "0.0035,-0.0003,0");
    }
    if (!request.inertia.empty()) {
        mass.inertia = inertia_option(request.inertia);
    }
    if (mass.given() != 1) {
        throw Error(mass.is_given()
                        ? "--density, --mass and --area-density exclude each other; give one of them"
                        : "the mass is missing; give --density, --mass or --area-density");
    }
    if (!mass.mass && (mass.center_of_mass || mass.inertia)) {
        throw Error(fmt::format("{} contradicts a uniform density; give --mass instead",
                                mass.inertia ? "--inertia" : "--center-of-mass"));
    }
    return mass;
}

nlohmann::json run(const Request& request, bool json) {
    const MassSpecification mass = asked(request);
    const std::string output = request.output.empty() ? request.file : request.output;
    if (!is_body_file_name(output)) {
        throw Error(fmt::format("{}: the name of a body file must end in .body.h5", output));
    }
    Body body = read_body_file(request.file);
    if (const std::string error = error_of(mass, body.surface); !error.empty()) {
        throw Error(fmt::format("{}: {}", request.file, error));
    }
    body.mass = mass;
    write_body_file(output, body);
    if (!json) print_mass(body);
    nlohmann::json result = body_as_json(body)["mass"];
    result["output"] = output;
    return result;
}

}  // namespace

int mass_command(int argc, const char* const* argv) {
    Request request;
    Arguments arguments("samara mass",
                        "Sets the default mass in a body file, for scenes that do not give one.");
    arguments.positional("FILE", request.file, "body file (.body.h5)");
    arguments.output_option("-o,--output", request.output, "body file to write; by default FILE itself");
    arguments.option("--density", request.density, "uniform density, kg/m^3", 1e-3, 1e6);
    arguments.option("--mass", request.mass, "mass in kg, instead of a density", 1e-15, 1e15);
    arguments.option(
        "--area-density", request.area_density,
        "mass by area in g/m^2, as paper is sold: of half the surface; copies of other sizes keep "
        "the thickness",
        1e-3, 1e9);
    arguments.option("--center-of-mass", request.center_of_mass,
                     "x,y,z: centre of mass in metres, shape axes; by default the centroid of the volume");
    arguments.option(
        "--inertia", request.inertia,
        "xx,yy,zz: moments (kg m^2) about the centre of mass, shape axes; may be followed by the "
        "entries xy,xz,yz of the tensor; by default as of uniform density");
    arguments.footer(
        "A density or mass in a scene takes precedence.\n"
        "JSON: density (null where the mass is given), mass, center_of_mass, inertia (3x3), output.\n\n"
        "Example: samara mass seed.body.h5 --mass 1.42e-4 --center-of-mass 0.0035,-0.0003,0");
    return run_program(argc, argv, arguments, [&] { return run(request, arguments.json()); });
}

}  // namespace samara
