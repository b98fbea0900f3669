#pragma once

#include <vector>

#include "samara/core/body/body.hpp"

namespace samara {

/// The loads in one direction with their errors, all in map axes (the columns of symmetry.axes).
struct DirectionSample {
    Vector3d direction;  ///< unit vector: the body's velocity relative to the fluid
    LoadEntry entry;
    LoadEntryError error;
};

/// Transforms an entry by the orthogonal matrix R: a force F becomes R F; a moment M, which is an axial
/// vector, det(R) R M.
LoadEntry transformed(const LoadEntry& entry, const Matrix3d& rotation);

/// Transforms standard errors like transformed(), with the components' errors taken as independent:
/// s_i^2 = sum over j of R_ij^2 s_j^2.
LoadEntryError transformed_error(const LoadEntryError& error, const Matrix3d& rotation);

/// Returns a + factor b, number by number.
LoadEntry plus(const LoadEntry& a, double factor, const LoadEntry& b);

/// Return an entry with every number squared, or replaced by its square root.
LoadEntry squared(const LoadEntry& entry);
LoadEntry rooted(const LoadEntry& squares);

/// How many components of force and moment the symmetry allows in a direction: 0 to 3.
struct AllowedComponents {
    int force;
    int moment;
};

/// Returns the allowed components in a direction.
AllowedComponents allowed_components(const Symmetry& symmetry, const Vector3d& direction);

/// The components of force and moment that the symmetry leaves free in the directions around one, as
/// diagonals of the orthogonal projections onto the allowed loads. All 1 for a finite symmetry; for a body of
/// revolution the force lies in the plane of its axis and the direction, and the moment is perpendicular to
/// it.
struct FreeComponents {
    Vector3d force;
    Vector3d moment;
};

/// Returns the free components around a direction.
FreeComponents free_components(const Symmetry& symmetry, const Vector3d& direction);

/// Removes the components that the body's symmetry forbids from the samples of one Reynolds number: the part
/// of force and moment that changes under an element that leaves the direction unchanged. The removed part is
/// a sample of the solution's error, since its true mean is zero: its root mean square per forbidden
/// component is added in quadrature to the error of every component of that force or moment. Where the
/// symmetry forbids nothing, the root mean square over all samples is added instead. Returns the added
/// errors, sample by sample.
std::vector<LoadEntryError> keep_symmetric_part(const Symmetry& symmetry,
                                                std::vector<DirectionSample>& samples);

}  // namespace samara
