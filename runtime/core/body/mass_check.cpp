#include "samara/core/body/mass_check.hpp"

#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "samara/core/base/symmetric_matrix.hpp"

namespace samara {
namespace {

constexpr double rounding = 1e-9;

std::string error_of_number(const std::optional<double>& value, const char* name) {
    if (!value || (*value > 0.0 && std::isfinite(*value))) return {};
    return fmt::format("{} must be a positive number, not {}", name, *value);
}

std::string error_of_center(const Vector3d& center, const Surface& surface) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& vertex : surface.vertices) box.extend(vertex);
    const Vector3d slack = Vector3d::Constant(rounding * box.diagonal().norm());
    if (box.isEmpty() || Eigen::AlignedBox3d(box.min() - slack, box.max() + slack).contains(center))
        return {};
    return fmt::format(
        "center_of_mass ({:.4g}, {:.4g}, {:.4g}) m must lie within the box of the shape, from ({:.4g}, "
        "{:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) m",
        center.x(), center.y(), center.z(), box.min().x(), box.min().y(), box.min().z(), box.max().x(),
        box.max().y(), box.max().z());
}

std::string error_of_inertia(const Matrix3d& inertia) {
    if (!inertia.allFinite()) return "inertia must be of finite numbers";
    if ((inertia - inertia.transpose()).norm() > rounding * inertia.norm()) {
        return "inertia must be symmetric";
    }
    const Vector3d principal = eigenvalues_of(inertia);
    if (principal.x() > 0.0 && principal.z() <= (principal.x() + principal.y()) * (1.0 + rounding)) return {};
    return fmt::format(
        "no body has the principal moments of inertia {:.4g}, {:.4g}, {:.4g}: each must be positive and at "
        "most the sum of the others",
        principal.x(), principal.y(), principal.z());
}

}  // namespace

std::string error_of(const MassSpecification& mass) {
    if (!mass.is_given()) return "density or mass must be given";
    std::string error = error_of_number(mass.density, "density");
    if (error.empty()) error = error_of_number(mass.mass, "mass");
    if (error.empty() && mass.center_of_mass && !mass.center_of_mass->allFinite()) {
        error = "center_of_mass must be of finite numbers";
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
