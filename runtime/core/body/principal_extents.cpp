#include "samara/core/body/principal_extents.hpp"

#include <limits>

namespace samara {

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
