#pragma once

#include <optional>
#include <vector>

#include "meshes/symmetry/image_comparison.hpp"
#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// A rotation by `angle` (radians) about the unit vector `axis`, followed by the inversion x -> -x where
/// `improper`: a mirror across `axis` is the improper rotation by half a turn.
struct Operation {
    Vector3d axis = Vector3d::UnitZ();
    double angle = 0.0;
    bool improper = false;

    [[nodiscard]] Matrix3d matrix() const;
};

/// Whether two orthogonal matrices are the same element, but for the small turn that the tolerance allows.
bool is_same_element(const Matrix3d& a, const Matrix3d& b);

/// The 48 rotations and reflections of the cube along the axes, the identity first.
std::vector<Matrix3d> signed_permutations();

/// A finite group of rotations and reflections under which a body looks the same, grown element by element.
class SymmetryGroup {
  public:
    explicit SymmetryGroup(const ImageComparison& images) : images_(images) {}

    /// Adds the element, and all products with it, if the body's images agree; products within twice the
    /// tolerance. Does nothing otherwise, or where the group has it already.
    void add(const Matrix3d& element);

    /// Turns the operation's axis to where the images agree best, if they nearly do, then adds it. Does
    /// nothing any more once many operations had no end of products.
    void add_refined(const Operation& operation);

    [[nodiscard]] bool contains(const Matrix3d& element) const;
    [[nodiscard]] const std::vector<Matrix3d>& elements() const { return elements_; }

  private:
    // The group with the element and all products; none where there is no end of them.
    [[nodiscard]] std::optional<std::vector<Matrix3d>> grown_by(const Matrix3d& element) const;

    const ImageComparison& images_;
    std::vector<Matrix3d> elements_ = {Matrix3d::Identity()};
    int endless_ = 0;  // operations that the images agreed with, but that no finite group has
};

}  // namespace samara
