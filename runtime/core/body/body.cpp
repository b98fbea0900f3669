#include "samara/core/body/body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

Matrix3d principal_axes(const VolumeMoments& moments) {
    Matrix3d axes = principal_values(moments.second_moments).directions;
    if (axes.determinant() < 0.0) axes.col(2) = -axes.col(2);
    return axes;
}

Matrix3d uniform_inertia(const VolumeMoments& moments, double density) {
    return density * (moments.second_moments.trace() * Matrix3d::Identity() - moments.second_moments);
}

const char* name_of(Symmetry::Type type) {
    switch (type) {
        case Symmetry::Type::axial:
            return "axial";
        case Symmetry::Type::spherical:
            return "spherical";
        case Symmetry::Type::finite:
            break;
    }
    return "finite";
}

Matrix6d about_point(const Matrix6d& tensor, const Vector3d& old_point, const Vector3d& new_point) {
    // With v at the new point, the velocity at the old one is v + omega x (old - new).
    Matrix6d shift = Matrix6d::Identity();
    shift.block<3, 3>(3, 0) = -skew(old_point - new_point);
    return shift.transpose() * tensor * shift;
}

Matrix6d in_rotated_axes(const Matrix6d& tensor, const Matrix3d& rotation) {
    Matrix6d to_new = Matrix6d::Zero();
    to_new.block<3, 3>(0, 0) = rotation;
    to_new.block<3, 3>(3, 3) = rotation;
    return to_new * tensor * to_new.transpose();
}

double tensor_error_of(const ShapeError& error, const VolumeMoments& moments, const Matrix6d& tensor) {
    // A surface that lies further out by d carries fluid of d times its area where it is blunt. A thin body's
    // added mass is far above its volume: its rim decides.
    const double carried = moments.volume + tensor.bottomRightCorner<3, 3>().trace() / 3.0;
    // Angular blocks grow with the fifth power of a length, the volume with the third.
    constexpr double of_volume = 5.0 / 3.0;
    // A sphere carries half its volume; a sheet's volume says nothing of what it carries.
    const double share = std::min(1.0, 1.5 * moments.volume / carried);
    return std::max(of_volume * share * std::max(std::abs(error.volume), error.faceting),
                    error.mean_distance * moments.surface_area / carried);
}

MassSpecification mass_asked_or_own(const MassSpecification& asked, const Body& body) {
    return asked.is_given() ? asked : body.mass.value_or(asked);
}

MassProperties mass_properties(const Body& body, const MassSpecification& mass) {
    const VolumeMoments& moments = body.moments;
    MassProperties result;
    const double of_sheet = mass.area_density.value_or(0.0) * 0.5 * moments.surface_area;
    result.mass = mass.mass.value_or(mass.density ? *mass.density * moments.volume : of_sheet);
    result.center_of_mass = mass.center_of_mass.value_or(moments.centroid);
    result.inertia = mass.inertia.value_or(uniform_inertia(moments, result.mass / moments.volume));
    return result;
}

Vector3d principal_extents(const Body& body) {
    const Matrix3d axes = principal_axes(body.moments);
    const double infinity = std::numeric_limits<double>::infinity();
    Vector3d lowest = Vector3d::Constant(infinity);
    Vector3d highest = -lowest;
    for (const Vector3d& vertex : body.surface.vertices) {
        const Vector3d place = axes.transpose() * vertex;
        lowest = lowest.cwiseMin(place);
        highest = highest.cwiseMax(place);
    }
    return highest - lowest;
}

}  // namespace samara
