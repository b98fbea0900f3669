#pragma once

#include <array>
#include <vector>

namespace samara {

/// A point of a rule: barycentric coordinates and the share of the area.
struct RulePoint {
    std::array<double, 3> corner_shares;
    double weight;
};

/// Symmetric Gauss rules of a triangle with 3, 6, 12 and 16 points, exact to degree 2, 4, 6 and 8 (D. A.
/// Dunavant, Int. J. Numer. Methods Eng. 21(6), 1985).
const std::vector<RulePoint>& triangle_rule_3();
const std::vector<RulePoint>& triangle_rule_6();
const std::vector<RulePoint>& triangle_rule_12();
const std::vector<RulePoint>& triangle_rule_16();

}  // namespace samara
