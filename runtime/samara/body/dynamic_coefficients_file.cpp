#include "samara/body/dynamic_coefficients_file.hpp"

#include <cmath>

#include <fmt/format.h>

#include "samara/base/error.hpp"

namespace samara {
namespace {

constexpr const char* group = "/dynamic_coefficients";

std::string place(const char* name, const char* name_end = "") {
    return fmt::format("{}/{}{}", group, name, name_end);
}

Matrix3d read_tensor(const Hdf5Reader& file, const char* name, const char* name_end) {
    return from_row_major<Matrix3d>(file.finite_doubles(place(name, name_end), {3, 3}));
}

/// The numbers that values and standard errors have in common.
DynamicCoefficients read_numbers(const Hdf5Reader& file, const char* name_end) {
    DynamicCoefficients numbers;
    numbers.force_transport = file.number_attribute(group, fmt::format("force_transport{}", name_end));
    numbers.moment_transport = file.number_attribute(group, fmt::format("moment_transport{}", name_end));
    numbers.drag_in_motion = read_tensor(file, "drag_in_motion", name_end);
    numbers.rotational_drag = read_tensor(file, "rotational_drag", name_end);
    return numbers;
}

void write_numbers(Hdf5Writer& file, const DynamicCoefficients& numbers, const char* name_end,
                   const char* drag_meaning, const char* turning_meaning) {
    file.write(place("drag_in_motion", name_end), row_major(numbers.drag_in_motion), {3, 3}, "m^2",
               drag_meaning);
    file.write(place("rotational_drag", name_end), row_major(numbers.rotational_drag), {3, 3}, "m^4",
               turning_meaning);
    file.attribute(group, fmt::format("force_transport{}", name_end), numbers.force_transport);
    file.attribute(group, fmt::format("moment_transport{}", name_end), numbers.moment_transport);
}

/// A standard error that is none; empty where all are.
std::string fault_of_errors(const DynamicCoefficients& errors) {
    if (!(errors.force_transport >= 0.0) || !std::isfinite(errors.force_transport))
        return "force_transport_error";
    if (!(errors.moment_transport >= 0.0) || !std::isfinite(errors.moment_transport))
        return "moment_transport_error";
    if (errors.drag_in_motion.minCoeff() < 0.0) return "drag_in_motion_error";
    if (errors.rotational_drag.minCoeff() < 0.0) return "rotational_drag_error";
    return {};
}

}  // namespace

void write_dynamic_coefficients(Hdf5Writer& file, const IdentifiedCoefficients& coefficients) {
    constexpr const char* error = "standard error of the tensor of the same name";
    write_numbers(file, coefficients.values, "", "C_m A, body axes", "C_w D about the centroid, body axes");
    write_numbers(file, coefficients.standard_errors, "_error", error, error);
    file.attribute(group, "half_length", coefficients.values.half_length);
    file.attribute(group, "origin", std::string_view(coefficients.values.origin));
}

IdentifiedCoefficients read_dynamic_coefficients(const Hdf5Reader& file) {
    IdentifiedCoefficients coefficients{.values = read_numbers(file, ""),
                                        .standard_errors = read_numbers(file, "_error")};
    coefficients.values.half_length = file.number_attribute(group, "half_length");
    coefficients.values.origin = file.text_attribute(group, "origin");
    const auto refuse = [&](const std::string& what) {
        throw Error(fmt::format("{}: {}/{}; put it right, or remove the group to fly with defaults",
                                file.path().string(), group, what));
    };
    if (const std::string fault = fault_of(coefficients.values); !fault.empty()) refuse(fault);
    if (const std::string name = fault_of_errors(coefficients.standard_errors); !name.empty()) {
        refuse(name + " is not a standard error: negative or not finite");
    }
    return coefficients;
}

}  // namespace samara
