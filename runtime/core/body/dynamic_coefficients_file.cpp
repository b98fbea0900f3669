#include "samara/core/body/dynamic_coefficients_file.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/files/row_major.hpp"

namespace samara {
namespace {

constexpr const char* group = "/dynamic_coefficients";
constexpr const char* lowest_density = "lowest_density";
constexpr const char* highest_density = "highest_density";
/// Of an angular momentum that the wake carried along, and of fluid that turned with the body.
constexpr const char* former_tensors[] = {"wake_by_velocity", "wake_by_turning", "entrained_inertia"};

std::string place(const char* name, const char* name_end = "") {
    return fmt::format("{}/{}{}", group, name, name_end);
}

Matrix3d read_tensor(const Hdf5Reader& file, const char* name, const char* name_end) {
    return from_row_major<Matrix3d>(file.finite_doubles(place(name, name_end), {3, 3}));
}

/// The numbers that values and standard errors have in common.
DynamicCoefficients read_numbers(const Hdf5Reader& file, const char* name_end) {
    DynamicCoefficients numbers;
    for (const NumberOfMotion& number : numbers_of_motion) {
        const std::string name = fmt::format("{}{}", number.name, name_end);
        if (number.is_late && !file.has_attribute(group, name)) {
            if (*name_end != '\0') numbers.*number.member = 0.0;
        } else {
            numbers.*number.member = file.number_attribute(group, name);
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
        file.attribute(group, fmt::format("{}{}", number.name, name_end), numbers.*number.member);
    }
}

/// Absent in files from before.
IdentifiedDensities read_densities(const Hdf5Reader& file) {
    if (!file.has_attribute(group, lowest_density) && !file.has_attribute(group, highest_density)) return {};
    return {file.number_attribute(group, lowest_density), file.number_attribute(group, highest_density)};
}

bool are_sound(const IdentifiedDensities& densities) {
    const auto& [lowest, highest] = densities;
    return (lowest == 0.0 && highest == 0.0) || (lowest > 0.0 && lowest <= highest && std::isfinite(highest));
}

/// A standard error that is none; empty where all are.
std::string fault_of_errors(const DynamicCoefficients& errors) {
    for (const NumberOfMotion& number : numbers_of_motion) {
        const double error = errors.*number.member;
        if (!(error >= 0.0) || !std::isfinite(error)) return std::string(number.name) + "_error";
    }
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        if ((errors.*tensor.member).minCoeff() < 0.0) return std::string(tensor.name) + "_error";
    }
    return {};
}

/// Whether the coefficients hold terms that flights no longer have.
bool is_of_an_earlier_form(const Hdf5Reader& file) {
    if (file.has_attribute(group, "force_transport")) return true;
    return std::any_of(std::begin(former_tensors), std::end(former_tensors), [&file](const char* name) {
        return file.has(place(name)) && !read_tensor(file, name, "").isZero(0.0);
    });
}

}  // namespace

void write_dynamic_coefficients(Hdf5Writer& file, const IdentifiedCoefficients& coefficients) {
    write_numbers(file, coefficients.values, "");
    write_numbers(file, coefficients.standard_errors, "_error");
    file.attribute(group, "half_length", coefficients.values.half_length);
    if (coefficients.densities.lowest > 0.0) {
        file.attribute(group, lowest_density, coefficients.densities.lowest);
        file.attribute(group, highest_density, coefficients.densities.highest);
    }
    file.attribute(group, "origin", std::string_view(coefficients.values.origin));
}

IdentifiedCoefficients read_dynamic_coefficients(const Hdf5Reader& file) {
    if (is_of_an_earlier_form(file)) {
        throw Error(fmt::format(
            "{}: {} is of an earlier form, which this version does not fly; bake the body again, or "
            "remove the group to fly with defaults",
            file.path().string(), group));
    }
    IdentifiedCoefficients coefficients{.values = read_numbers(file, ""),
                                        .standard_errors = read_numbers(file, "_error"),
                                        .densities = read_densities(file)};
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
    if (!are_sound(coefficients.densities)) {
        refuse("lowest_density and highest_density are not two positive numbers in ascending order");
    }
    return coefficients;
}

}  // namespace samara
