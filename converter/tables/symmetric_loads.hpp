#pragma once

#include <vector>

#include "samara/core/body/body.hpp"

namespace samara {

/// The loads found in one direction, all in map axes (the columns of symmetry.axes).
struct DirectionSample {
    Vector3d direction;  ///< unit vector: the body's velocity relative to the fluid
    LoadEntry entry;
    LoadEntryError error;
};

/// The entry in axes turned or mirrored by the orthogonal matrix: a force F becomes R F; a moment, which is
/// an axial vector, det(R) R M.
LoadEntry transformed(const LoadEntry& entry, const Matrix3d& rotation);

/// The standard errors of `transformed`, the components' errors taken as independent:
/// s_i^2 = sum over j of R_ij^2 s_j^2.
LoadEntryError transformed_error(const LoadEntryError& error, const Matrix3d& rotation);

/// a + factor b, number by number.
LoadEntry plus(const LoadEntry& a, double factor, const LoadEntry& b);

/// Every number of an entry squared, and the square roots of all numbers.
LoadEntry squared(const LoadEntry& entry);
LoadEntry rooted(const LoadEntry& squares);

/// How many components of force and moment the symmetry allows in a direction: 0 to 3.
struct AllowedComponents {
    int force;
    int moment;
};
AllowedComponents allowed_components(const Symmetry& symmetry, const Vector3d& direction);

/// Which components of force and moment the symmetry leaves free in the directions around one: the diagonals
/// of the orthogonal projections onto what it allows there. All 1 for a finite symmetry; for a body of
/// revolution the force lies in the plane of its axis and the direction, and the moment across it.
struct FreeComponents {
    Vector3d force;
    Vector3d moment;
};
FreeComponents free_components(const Symmetry& symmetry, const Vector3d& direction);

/// Takes from the samples of one Reynolds number what the body's symmetry forbids: the part of force and
/// moment that changes under an element that leaves the direction as it is. What was taken away is a sample
/// of the solution's error, since the true mean is zero: its root mean square per forbidden component is
/// added (in quadrature) to the error of every component of that force or moment. Where the symmetry forbids
/// nothing, the root mean square over all samples is added instead. Returns what was added, sample by sample.
std::vector<LoadEntryError> keep_symmetric_part(const Symmetry& symmetry,
                                                std::vector<DirectionSample>& samples);

}  // namespace samara
