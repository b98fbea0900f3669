#include "converter/samples_csv.hpp"

#include <fmt/format.h>

namespace samara {
namespace {

constexpr const char* heading =
    "name,purpose,mesh,closure,direction_x,direction_y,direction_z,reynolds_number,"
    "force_x,force_y,force_z,moment_x,moment_y,moment_z,turbulent_kinetic_energy,dissipation_rate,"
    "force_error_x,force_error_y,force_error_z,moment_error_x,moment_error_y,moment_error_z,"
    "turbulent_kinetic_energy_error,dissipation_rate_error\n";

/// As RFC 4180 wants it: in quotation marks where it holds a separator.
std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

std::string columns(const Vector3d& vector) {
    return fmt::format("{},{},{}", vector.x(), vector.y(), vector.z());
}

std::string columns(const LoadEntry& entry) {
    return fmt::format("{},{},{},{}", columns(entry.force), columns(entry.moment),
                       entry.turbulent_kinetic_energy, entry.dissipation_rate);
}

}  // namespace

std::string samples_csv(const std::vector<SolvedCase>& cases, const Matrix3d& axes) {
    std::string text = heading;
    for (const SolvedCase& solved : cases) {
        const auto& [direction, entry, error] = solved.sample;
        text += fmt::format("{},{},{},{},{},{},{},{}\n", quoted(solved.name), name_of(solved.purpose),
                            quoted(solved.mesh), quoted(solved.closure), columns(Vector3d(axes * direction)),
                            solved.reynolds_number, columns(transformed(entry, axes)),
                            columns(transformed_error(error, axes)));
    }
    return text;
}

}  // namespace samara
