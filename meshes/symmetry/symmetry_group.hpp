#pragma once

#include <optional>
#include <vector>

#include "meshes/symmetry/image_comparison.hpp"
#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// Returns a right-handed frame with the unit vector `axis`, or its opposite, as the column where it is
/// largest, by the smallest rotation from the identity.
Matrix3d frame_about(const Vector3d& axis);

/// A finite group of rotations and reflections, and a frame for it.
struct AlignedGroup {
    /// A right-handed frame (columns), aligned with mirrors and rotation axes so that as many elements as
    /// possible are signed permutations of them; of equally good frames the one nearest to the identity.
    Matrix3d axes = Matrix3d::Identity();
    /// The identity first. Products of elements are elements but for rounding.
    std::vector<Matrix3d> elements;
};

/// Finds the exact group near elements that were found within a tolerance: each is replaced by the mean of
/// the quotients that equal it until all agree (Grove, Karcher and Ruh, Math. Ann. 211, 1974). Where the
/// elements that permute `axes` are given as exactly signed permutations, the whole group is rotated into the
/// shape's axes: `axes` is the identity and these elements stay exact.
AlignedGroup aligned_group(const std::vector<Matrix3d>& elements);

/// A rotation by `angle` (radians) about the unit vector `axis`, followed by the inversion x -> -x where
/// `improper`: a mirror perpendicular to `axis` is the improper rotation by 180 degrees.
struct Operation {
    Vector3d axis = Vector3d::UnitZ();
    double angle = 0.0;
    bool improper = false;

    [[nodiscard]] Matrix3d matrix() const;
};

/// Whether two orthogonal matrices are the same element, but for the small rotation that the tolerance
/// allows.
bool is_same_element(const Matrix3d& a, const Matrix3d& b);

/// Returns the 48 rotations and reflections of the cube along the axes, the identity first.
std::vector<Matrix3d> signed_permutations();

/// A finite group of rotations and reflections that map a body onto itself, built element by element.
class SymmetryGroup {
  public:
    explicit SymmetryGroup(const ImageComparison& images) : images_(images) {}

    /// Adds the element and all products with it, if the body's images agree (products within twice the
    /// tolerance). Does nothing otherwise, or where the group has it already.
    void add(const Matrix3d& element);

    /// Refines the operation's axis to where the images agree best, if they nearly do, then adds it. Does
    /// nothing once many operations had no finite group.
    void add_refined(const Operation& operation);

    [[nodiscard]] bool contains(const Matrix3d& element) const;
    [[nodiscard]] const std::vector<Matrix3d>& elements() const { return elements_; }

  private:
    // Returns the group with the element and all products; nothing where they are too many for a finite
    // group.
    [[nodiscard]] std::optional<std::vector<Matrix3d>> grown_by(const Matrix3d& element) const;

    const ImageComparison& images_;
    std::vector<Matrix3d> elements_ = {Matrix3d::Identity()};
    int endless_ = 0;  // operations that fit the images, but are in no finite group
};

}  // namespace samara
