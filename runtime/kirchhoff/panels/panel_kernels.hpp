#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "samara/kirchhoff/panels/curved_panels.hpp"
#include "samara/kirchhoff/panels/triangle_rules.hpp"

// The inner loops of the curved boundary elements, built for several instruction sets (Highway); the best
// that the machine has is taken at run time.
//
// Nodes are worked on in groups of `group_size`. A group's rows of a matrix are stored column by column:
// element (i, j) at [j * group_size + i].

namespace samara {

inline constexpr std::size_t group_size = 16;

/// The places of a group of nodes.
template <typename Real>
struct NodeGroup {
    alignas(64) std::array<Real, group_size> x;
    alignas(64) std::array<Real, group_size> y;
    alignas(64) std::array<Real, group_size> z;
};

/// One panel's quadrature points under a rule, with all that does not depend on where they are seen from.
template <typename Real>
struct SourcePoint {
    std::array<Real, 3> place;   ///< y
    std::array<Real, 3> normal;  ///< area normal times weight / (4 pi)
    std::array<Real, 3> moment;  ///< y cross `normal`
};

/// A rule as the sums over a whole panel use it, and the points of all panels under it, panel by panel.
template <typename Real>
struct SourcePoints {
    std::size_t points = 0;                      ///< of one panel
    std::vector<std::array<Real, 6>> functions;  ///< the node functions at each point
    std::vector<SourcePoint<Real>> sources;
};

/// A piece of a panel's unit triangle: the rule's p and q run from `corner` along the two sides.
struct PanelPiece {
    std::array<double, 2> corner;
    std::array<double, 2> side_p;
    std::array<double, 2> side_q;
};

/// Sums over the points of panels as seen from one node, in the panel's polynomials 1, p, q, p^2, pq, q^2
/// instead of the node functions, each spread over the lanes of a vector register.
struct PolynomialSums {
    alignas(64) std::array<std::array<double, 8>, 9> lanes;
};

/// Three components of a potential at the nodes of a group.
using GroupPotentials = std::array<std::array<double, group_size>, 3>;

/// Adds the effects of the six node functions f_a on each of the panels listed at the group's nodes x: to the
/// group's rows of the matrix the integrals of (y - x).n f_a / (4 pi r^3), and to the potentials those of y
/// cross n / (4 pi r). In single precision; sums over many panels are taken in double.
void add_far_panels(const SourcePoints<float>& sources, const std::vector<CurvedPanel>& panels,
                    const std::vector<std::uint32_t>& list, const NodeGroup<float>& group, float* rows,
                    GroupPotentials& potentials);

/// Adds the integrals of add_far_panels() for one panel in double precision, at those nodes of the group
/// whose `share` is 1; it is 0 at the others.
void add_near_panel(const SourcePoints<double>& sources, const std::vector<CurvedPanel>& panels,
                    std::size_t panel, const NodeGroup<double>& group,
                    const std::array<double, group_size>& share, float* rows, GroupPotentials& potentials);

/// Adds the integrals over one piece of a panel as seen from `node`.
void add_piece(const TriangleRule& rule, const PanelPiece& piece, const CurvedPanel& panel,
               const Vector3d& node, PolynomialSums& sums);

/// Computes the product of a group's rows with six columns: `columns` holds six numbers for each of `count`
/// nodes, `product` gets six for each node of the group.
void multiply_group(const float* rows, std::size_t count, const double* columns, double* product);

/// Returns the sums of a group's rows over all columns.
std::array<double, group_size> row_sums(const float* rows, std::size_t count);

}  // namespace samara
