#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace samara {

/// Points and weights for integrals over the unit triangle p, q >= 0, p + q <= 1; the weights sum to 1/2.
/// The arrays are filled up to a multiple of eight points with points of no weight, for vector registers.
struct TriangleRule {
    std::vector<double> p;
    std::vector<double> q;
    std::vector<double> weight;
    std::size_t points = 0;  ///< without those of no weight
    int degree = 0;          ///< highest degree of polynomials that it integrates exactly
};

/// Returns the nodes and weights of Gauss and Legendre on [0, 1], exact up to degree 2 n - 1.
std::pair<std::vector<double>, std::vector<double>> gauss_legendre(int n);

/// Returns a rule that is exact for polynomials of `degree`: symmetric rules with 3, 6, 12 and 16 points for
/// the degrees 2, 4, 6 and 8 (D. A. Dunavant, Int. J. Numer. Methods Eng. 21, 1985); for other degrees a
/// product of Gauss rules collapsed into a corner, about (degree / 2 + 1)^2 points.
TriangleRule triangle_rule(int degree);

/// A point of a rule by its barycentric coordinates, and its share of the triangle's area.
struct RulePoint {
    std::array<double, 3> corner_shares;
    double weight;
};

/// Returns the symmetric rule for the degree 2, 4, 6 or 8 by barycentric coordinates: 3, 6, 12 or 16 points.
const std::vector<RulePoint>& symmetric_rule(int degree);

/// Returns a rule for integrands that are singular as 1/r in the corner p = q = 0: a Gauss rule along the
/// rays from that corner and one across them (M. G. Duffy, SIAM J. Numer. Anal. 19(6), 1982).
TriangleRule corner_rule(int radial_points, int angular_points);

}  // namespace samara
