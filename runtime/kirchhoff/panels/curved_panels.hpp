#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "samara/core/surface/surface.hpp"

namespace samara {

/// A curved triangle with six nodes: the place is the polynomial
/// c0 + c1 p + c2 q + c3 p^2 + c4 p q + c5 q^2 of the coordinates p, q of the unit triangle, with the corners
/// at (0,0), (1,0) and (0,1).
struct CurvedPanel {
    std::array<std::int32_t, 6> nodes;  ///< the corners, then the middles of the edges 01, 12 and 20
    std::array<Vector3d, 6> coefficients;
    Vector3d centre;      ///< the place of p = q = 1/3
    double radius = 0.0;  ///< from the centre to the farthest node
    bool bent = false;    ///< whether its area normal changes by more than 1.5 times its least length

    [[nodiscard]] Vector3d place(double p, double q) const;
    /// Returns the cross product of the two tangents: along the outward normal, as long as the panel's area
    /// is to that of the unit triangle.
    [[nodiscard]] Vector3d area_normal(double p, double q) const;
    /// Returns the tangents d/dp and d/dq, one a column.
    [[nodiscard]] Eigen::Matrix<double, 3, 2> tangents(double p, double q) const;
};

/// An order-2 surface as the curved boundary elements see it. Neighbouring nodes have neighbouring numbers.
struct CurvedPanels {
    std::vector<Vector3d> nodes;
    std::vector<CurvedPanel> panels;
};

/// Returns the values at (p, q) of the six quadratic functions that are 1 at one node and 0 at the others.
std::array<double, 6> node_functions(double p, double q);

/// The coordinates (p, q) of the six nodes.
inline constexpr std::array<std::array<double, 2>, 6> node_coordinates = {
    {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}}};

/// Returns the panels of an order-2 surface, with its vertices put in the order of a space-filling curve.
/// Vertices that belong to no triangle are left out. Throws Error at a triangle that is degenerate or not
/// finite.
CurvedPanels make_curved_panels(const Surface& surface);

/// Returns the share of the full solid angle about each node that lies inside the body, from the tangents of
/// the panels around it: 1/2 where the surface is smooth.
std::vector<double> interior_shares(const CurvedPanels& panels, int threads = 0);

}  // namespace samara
