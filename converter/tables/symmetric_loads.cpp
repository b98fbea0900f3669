#include "converter/tables/symmetric_loads.hpp"

#include <cmath>

#include "converter/tables/direction_sampling.hpp"

namespace samara {
namespace {

/// Orthogonal projections onto the forces and moments that the symmetry allows in one direction.
struct AllowedLoads {
    Matrix3d force = Matrix3d::Zero();
    Matrix3d moment = Matrix3d::Zero();
};

/// Averages the elements that keep the direction, which gives the projection onto the loads that all of them
/// leave unchanged.
AllowedLoads allowed_by_elements(const Symmetry& symmetry, const Vector3d& direction) {
    AllowedLoads allowed;
    double count = 0.0;
    for (const Matrix3d& element : elements_in_map_axes(symmetry)) {
        if ((element * direction - direction).norm() > direction_tolerance(symmetry)) continue;
        allowed.force += element;
        allowed.moment += element.determinant() * element;
        count += 1.0;
    }
    allowed.force /= count;
    allowed.moment /= count;
    return allowed;
}

/// Uses the mirror of a body of revolution through its axis and the direction.
AllowedLoads allowed_about_axis(const Symmetry& symmetry, const Vector3d& direction) {
    const AxialArc arc = axial_arc(symmetry, 1);
    const double tolerance = direction_tolerance(symmetry);
    const Vector3d normal = arc.axis.cross(direction);
    AllowedLoads allowed;
    if (normal.norm() < tolerance) {
        allowed.force = arc.axis * arc.axis.transpose();
    } else if (arc.mirrored && std::abs(arc.axis.dot(direction)) < tolerance) {
        allowed.force = direction * direction.transpose();
    } else {
        allowed.moment = normal.normalized() * normal.normalized().transpose();
        allowed.force = Matrix3d::Identity() - allowed.moment;
    }
    return allowed;
}

AllowedLoads allowed_loads(const Symmetry& symmetry, const Vector3d& direction) {
    switch (symmetry.type) {
        case Symmetry::Type::spherical:
            return {direction * direction.transpose(), Matrix3d::Zero()};
        case Symmetry::Type::axial:
            return allowed_about_axis(symmetry, direction);
        case Symmetry::Type::finite:
            break;
    }
    return allowed_by_elements(symmetry, direction);
}

/// The removed part: a sum of squares over a number of components.
struct Forbidden {
    double squares = 0.0;
    double components = 0.0;

    [[nodiscard]] double mean_square() const { return components > 0.0 ? squares / components : 0.0; }
};

Forbidden remove_forbidden(Vector3d& load, const Matrix3d& allowed) {
    const Vector3d kept = allowed * load;
    const Forbidden forbidden{(load - kept).squaredNorm(), std::round(3.0 - allowed.trace())};
    load = kept;
    return forbidden;
}

void widen(Vector3d& error, double mean_square) {
    error = (error.array().square() + mean_square).sqrt();
}

/// Applies keep_symmetric_part() to the force or the moment.
void keep_allowed(std::vector<DirectionSample>& samples, const std::vector<AllowedLoads>& allowed,
                  Matrix3d AllowedLoads::*projection, Vector3d LoadEntry::*load,
                  std::vector<LoadEntryError>& added) {
    std::vector<Forbidden> each;
    Forbidden all;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        each.push_back(remove_forbidden(samples[i].entry.*load, allowed[i].*projection));
        all.squares += each[i].squares;
        all.components += each[i].components;
    }
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double mean_square = each[i].components > 0.0 ? each[i].mean_square() : all.mean_square();
        widen(samples[i].error.*load, mean_square);
        (added[i].*load).setConstant(std::sqrt(mean_square));
    }
}

}  // namespace

LoadEntry transformed(const LoadEntry& entry, const Matrix3d& rotation) {
    LoadEntry result = entry;
    result.force = rotation * entry.force;
    result.moment = rotation.determinant() * (rotation * entry.moment);
    return result;
}

LoadEntryError transformed_error(const LoadEntryError& error, const Matrix3d& rotation) {
    const Matrix3d squares = rotation.cwiseAbs2();
    LoadEntryError result = error;
    result.force = (squares * error.force.cwiseAbs2()).cwiseSqrt();
    result.moment = (squares * error.moment.cwiseAbs2()).cwiseSqrt();
    return result;
}

LoadEntry plus(const LoadEntry& a, double factor, const LoadEntry& b) {
    return {a.force + factor * b.force, a.moment + factor * b.moment,
            a.turbulent_kinetic_energy + factor * b.turbulent_kinetic_energy,
            a.dissipation_rate + factor * b.dissipation_rate};
}

LoadEntry squared(const LoadEntry& entry) {
    return {entry.force.cwiseAbs2(), entry.moment.cwiseAbs2(),
            entry.turbulent_kinetic_energy * entry.turbulent_kinetic_energy,
            entry.dissipation_rate * entry.dissipation_rate};
}

LoadEntry rooted(const LoadEntry& squares) {
    return {squares.force.cwiseSqrt(), squares.moment.cwiseSqrt(),
            std::sqrt(squares.turbulent_kinetic_energy), std::sqrt(squares.dissipation_rate)};
}

AllowedComponents allowed_components(const Symmetry& symmetry, const Vector3d& direction) {
    const AllowedLoads allowed = allowed_loads(symmetry, direction);
    return {static_cast<int>(std::lround(allowed.force.trace())),
            static_cast<int>(std::lround(allowed.moment.trace()))};
}

FreeComponents free_components(const Symmetry& symmetry, const Vector3d& direction) {
    if (symmetry.type == Symmetry::Type::finite) return {Vector3d::Ones(), Vector3d::Ones()};
    if (symmetry.type == Symmetry::Type::spherical) return {direction.cwiseAbs2(), Vector3d::Zero()};
    const Vector3d axis = axial_arc(symmetry, 1).axis;
    const Vector3d normal = axis.cross(direction);
    // On the axis the planes of all directions intersect.
    if (normal.norm() < direction_tolerance(symmetry)) {
        return {Vector3d::Ones(), Vector3d::Ones() - axis.cwiseAbs2()};
    }
    const Vector3d across = normal.normalized().cwiseAbs2();
    return {Vector3d::Ones() - across, across};
}

std::vector<LoadEntryError> keep_symmetric_part(const Symmetry& symmetry,
                                                std::vector<DirectionSample>& samples) {
    std::vector<AllowedLoads> allowed;
    allowed.reserve(samples.size());
    for (const DirectionSample& sample : samples) {
        allowed.push_back(allowed_loads(symmetry, sample.direction));
    }
    std::vector<LoadEntryError> added(samples.size());
    keep_allowed(samples, allowed, &AllowedLoads::force, &LoadEntry::force, added);
    keep_allowed(samples, allowed, &AllowedLoads::moment, &LoadEntry::moment, added);
    return added;
}

}  // namespace samara
