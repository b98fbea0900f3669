#include "samara/core/body/body_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/surface/curved_surface.hpp"

namespace samara {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double least_radius = 1e-9;   // m
constexpr double most_radius = 1e9;     // m
constexpr double rounding = 1e-6;       // relative, of quantities that are exact but for rounding
constexpr double mass_rounding = 1e-9;  // relative, of a mass that a user gives
// The relative difference that is allowed between a surface in flat triangles and the curved one, or the body
// that it stands for.
constexpr double faceting = 0.25;
// Coefficients lie around one. Stokes flow adds 24/Re.
constexpr double most_coefficient = 1e3;

/// Returns the radius (m) of the ball about the point that holds all vertices.
double radius_about(const Surface& surface, const Vector3d& point) {
    double square = 0.0;
    for (const Vector3d& vertex : surface.vertices) square = std::max(square, (vertex - point).squaredNorm());
    return std::sqrt(square);
}

bool is_symmetric(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
    return (matrix - matrix.transpose()).cwiseAbs().maxCoeff() <= rounding * matrix.cwiseAbs().maxCoeff();
}

bool is_orthonormal(const Matrix3d& matrix) {
    return (matrix.transpose() * matrix - Matrix3d::Identity()).cwiseAbs().maxCoeff() <= rounding;
}

std::string error_of_moments(const Body& body, double radius) {
    const VolumeMoments& moments = body.moments;
    const double volume = moments.volume;
    if (!(volume > 0.0) || !std::isfinite(volume)) return "the volume is not positive";
    if (!(moments.surface_area > 0.0) || !std::isfinite(moments.surface_area)) {
        return "the surface area is not positive";
    }
    if (std::abs(enclosed_volume(body.surface) / volume - 1.0) > faceting) {
        return fmt::format("the volume of {:g} m^3 does not match the surface", volume);
    }
    // No body has less surface than the ball.
    if (std::cbrt(36.0 * pi * volume * volume) > (1.0 + faceting) * moments.surface_area) {
        return "the surface area is too small for the volume";
    }
    const Matrix3d& second = moments.second_moments;
    if (!is_symmetric(second)) return "/moments/second_moments is not symmetric";
    const Vector3d spread = eigenvalues_of(second) / volume;
    // The upper bound has the whole volume at the radius; the lower one is a cylinder as wide as the body and
    // as long as its volume takes.
    const double length = volume / (pi * radius * radius);
    if (spread.maxCoeff() > (1.0 + faceting) * radius * radius ||
        spread.minCoeff() < (1.0 - faceting) * length * length / 12.0) {
        return "/moments/second_moments do not match the body's volume and size";
    }
    return {};
}

std::string error_of(const Symmetry& symmetry) {
    if (!is_orthonormal(symmetry.axes)) return "/symmetry/axes is not a frame of orthogonal unit vectors";
    if (symmetry.type == Symmetry::Type::axial && std::abs(symmetry.axis.norm() - 1.0) > rounding) {
        return "/symmetry/axis is not a unit vector";
    }
    if (symmetry.elements.empty()) return "/symmetry/elements lacks the identity";
    if (!std::all_of(symmetry.elements.begin(), symmetry.elements.end(), is_orthonormal)) {
        return "/symmetry/elements holds a matrix that is not orthogonal";
    }
    if (!(symmetry.tolerance >= 0.0) || !std::isfinite(symmetry.tolerance)) {
        return "the symmetry's tolerance is negative or not finite";
    }
    return {};
}

std::string error_of(const ShapeError& error) {
    for (const double metric : {error.distance, error.mean_distance, error.faceting}) {
        if (!(metric >= 0.0) || !std::isfinite(metric)) {
            return "/surface has a distance from its shape that is negative or not finite";
        }
    }
    const bool finite = std::isfinite(error.volume) && std::isfinite(error.area);
    return finite ? "" : "/surface has a change of volume or area that is not finite";
}

std::string error_of(const KirchhoffTensor& kirchhoff, double radius) {
    constexpr const char* place = "/kirchhoff/added_mass";
    // Lengths over the radius, so that the blocks compare: the sphere around the body has 2/3 pi.
    Vector6d scale;
    scale << Vector3d::Constant(std::pow(radius, -2.5)), Vector3d::Constant(std::pow(radius, -1.5));
    const Matrix6d tensor = scale.asDiagonal() * kirchhoff.matrix * scale.asDiagonal();
    if (!is_symmetric(tensor)) return fmt::format("{} is not symmetric", place);
    const Vector6d values = eigenvalues_of(tensor);
    if (values.minCoeff() < -rounding * values.maxCoeff()) {
        return fmt::format("{} is not positive semidefinite", place);
    }
    const Matrix3d mass = tensor.bottomRightCorner<3, 3>();
    if (!(eigenvalues_of(mass).minCoeff() > 0.0)) {
        return fmt::format("{} is not positive for every velocity", place);
    }
    // A body and the fluid that it moves weigh no more than the ball around it and what that moves: 2 pi.
    if (values.maxCoeff() > 4.0 * pi) return fmt::format("{} is too large for the body", place);
    for (const double metric : {kirchhoff.error_estimate, kirchhoff.asymmetry}) {
        if (!(metric >= 0.0) || !std::isfinite(metric)) {
            return "/kirchhoff has an error_estimate or asymmetry that is negative or not finite";
        }
    }
    return kirchhoff.triangles >= 0 ? "" : "/kirchhoff has a negative number of triangles";
}

std::string error_of(const LoadTables& tables, double surface_area) {
    if (!is_orthonormal(tables.axes)) return "/tables/axes is not a frame of orthogonal unit vectors";
    if (std::abs(tables.reference_length / reference_length(surface_area) - 1.0) > faceting) {
        return "/tables has a reference_length that is not sqrt(S/pi) of the surface";
    }
    const double most = most_coefficient * (1.0 + 1.0 / tables.reynolds_numbers.front());
    for (const LoadEntry& entry : tables.entries) {
        if (entry.turbulent_kinetic_energy < 0.0) return "/tables/turbulent_kinetic_energy is negative";
        if (entry.dissipation_rate < 0.0) return "/tables/dissipation_rate is negative";
        const double largest =
            std::max({entry.force.cwiseAbs().maxCoeff(), entry.moment.cwiseAbs().maxCoeff(),
                      entry.turbulent_kinetic_energy, entry.dissipation_rate});
        if (largest > most) return fmt::format("/tables holds a coefficient of {:g}", largest);
    }
    for (const LoadEntryError& error : tables.errors) {
        if (error.force.minCoeff() < 0.0 || error.moment.minCoeff() < 0.0 ||
            error.turbulent_kinetic_energy < 0.0 || error.dissipation_rate < 0.0) {
            return "/tables holds a standard error that is negative";
        }
    }
    for (const ErrorShare& share : tables.error_sources) {
        if (std::min({share.force, share.moment, share.turbulent_kinetic_energy, share.dissipation_rate}) <
            0.0) {
            return "/tables/error_sources is negative";
        }
    }
    return {};
}

/// Checks the coefficients against the body's size, beyond what error_of(DynamicCoefficients) asks.
std::string error_of(const DynamicCoefficients& coefficients, double radius) {
    const auto place = [](const char* name) {
        return fmt::format("/dynamic_coefficients/{} is too large for the body", name);
    };
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        const int power = std::string_view(tensor.unit).back() - '0';  // "m^4"
        const double largest = (coefficients.*tensor.member).cwiseAbs().maxCoeff();
        if (largest > most_coefficient * std::pow(radius, power)) return place(tensor.name);
    }
    for (const NumberOfMotion& number : numbers_of_motion) {
        if (std::abs(coefficients.*number.member) > most_coefficient) return place(number.name);
    }
    return coefficients.half_length <= 2.0 * radius ? "" : place("half_length");
}

std::string error_of_number(const std::optional<double>& value, const char* name) {
    if (!value || (*value > 0.0 && std::isfinite(*value))) return {};
    return fmt::format("{} must be a positive number, not {}", name, *value);
}

std::string error_of_center(const Vector3d& center, const Surface& surface) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& vertex : surface.vertices) box.extend(vertex);
    const Vector3d slack = Vector3d::Constant(mass_rounding * box.diagonal().norm());
    if (box.isEmpty() || Eigen::AlignedBox3d(box.min() - slack, box.max() + slack).contains(center))
        return {};
    return fmt::format(
        "center_of_mass ({:.4g}, {:.4g}, {:.4g}) m must lie within the box of the shape, from ({:.4g}, "
        "{:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) m",
        center.x(), center.y(), center.z(), box.min().x(), box.min().y(), box.min().z(), box.max().x(),
        box.max().y(), box.max().z());
}

std::string error_of_inertia(const Matrix3d& inertia) {
    if (!inertia.allFinite()) return "inertia must be finite";
    if ((inertia - inertia.transpose()).norm() > mass_rounding * inertia.norm()) {
        return "inertia must be symmetric";
    }
    const Vector3d principal = eigenvalues_of(inertia);
    if (principal.x() > 0.0 && principal.z() <= (principal.x() + principal.y()) * (1.0 + mass_rounding))
        return {};
    return fmt::format(
        "the principal moments of inertia {:.4g}, {:.4g}, {:.4g} are impossible: each must be positive and "
        "at most the sum of the others",
        principal.x(), principal.y(), principal.z());
}

}  // namespace

std::string error_of(const Body& body) {
    if (body.surface.vertices.empty() || body.surface.corners.empty()) return "/surface has no triangles";
    const double radius = radius_about(body.surface, body.moments.centroid);
    if (!(radius > least_radius && radius < most_radius)) {
        return fmt::format("/surface reaches {:g} m from the centroid, which is too large", radius);
    }
    const Eigen::AlignedBox3d hull = [&] {
        Eigen::AlignedBox3d box;
        for (const Vector3d& vertex : body.surface.vertices) box.extend(vertex);
        return box;
    }();
    if (hull.exteriorDistance(body.moments.centroid) > rounding * radius) {
        return "/moments/centroid lies outside the surface";
    }
    std::string error = error_of_moments(body, radius);
    if (error.empty()) error = error_of(body.symmetry);
    if (error.empty() && body.shape_error) error = error_of(*body.shape_error);
    if (error.empty() && body.kirchhoff) error = error_of(*body.kirchhoff, radius);
    if (error.empty() && body.tables) error = error_of(*body.tables, body.moments.surface_area);
    if (error.empty() && body.dynamic) error = error_of(body.dynamic->values, radius);
    if (error.empty() && body.mass) error = error_of(*body.mass, body.surface);
    if (error.empty() && body.recommended) error = error_of(*body.recommended);
    return error;
}

std::string error_of(const MassSpecification& mass) {
    if (!mass.is_given()) return "give density, mass or area_density";
    std::string error = error_of_number(mass.density, "density");
    if (error.empty()) error = error_of_number(mass.mass, "mass");
    if (error.empty()) error = error_of_number(mass.area_density, "area_density");
    if (error.empty() && mass.center_of_mass && !mass.center_of_mass->allFinite()) {
        error = "center_of_mass must be finite";
    }
    if (error.empty() && mass.inertia) error = error_of_inertia(*mass.inertia);
    return error;
}

std::string error_of(const MassSpecification& mass, const Surface& surface) {
    std::string error = error_of(mass);
    if (error.empty() && mass.center_of_mass) error = error_of_center(*mass.center_of_mass, surface);
    return error;
}

}  // namespace samara
