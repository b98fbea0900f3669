#include "samara/kirchhoff/panels/flat_triangle_integrals.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "samara/kirchhoff/panels/single_layer_entries.hpp"
#include "samara/kirchhoff/panels/triangle_rules.hpp"

namespace samara {
namespace {

constexpr double pi = std::numbers::pi;

FlatTriangle common_triangle() {
    return flat_triangle({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.3, 0.8, 0.0});
}

double potential_at(const FlatTriangle& triangle, const Vector3d& point) {
    PointBatch points;
    for (std::size_t i = 0; i < point_batch; ++i) points.set(i, point);
    return uniform_potential(triangle, points).values[0];
}

/// The mean of f over the triangle, by 16 points on each of n^2 parts.
template <typename Function>
double mean_over(const FlatTriangle& triangle, int n, const Function& f) {
    const Vector3d u = (triangle.corners[1] - triangle.corners[0]) / n;
    const Vector3d v = (triangle.corners[2] - triangle.corners[0]) / n;
    double sum = 0.0;
    const auto add = [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
        for (const RulePoint& point : symmetric_rule(8)) {
            const auto& shares = point.corner_shares;
            sum += point.weight * f(Vector3d(shares[0] * a + shares[1] * b + shares[2] * c));
        }
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; i + j < n; ++j) {
            const Vector3d a = triangle.corners[0] + i * u + j * v;
            add(a, a + u, a + v);
            if (i + j < n - 1) add(a + u + v, a + v, a + u);
        }
    }
    return sum / (n * n);
}

/// The double integral of 1/r with the outer integral by many points.
double by_quadrature(const FlatTriangle& outer, const FlatTriangle& inner, int n) {
    return outer.area * mean_over(outer, n, [&](const Vector3d& x) { return potential_at(inner, x); });
}

/// The weight of corner k at a point of the triangle's plane.
double hat(const FlatTriangle& triangle, std::size_t k, const Vector3d& point) {
    const Vector3d edge = triangle.corners[(k + 2) % 3] - triangle.corners[(k + 1) % 3];
    const Vector3d arm = point - triangle.corners[(k + 1) % 3];
    return triangle.normal.dot(edge.cross(arm)) / (2.0 * triangle.area);
}

HatSums hat_sums(const FlatTriangle& triangle, const Vector3d& point) {
    SourceBatch batch{};
    for (std::size_t i = 0; i < point_batch; ++i) batch.points.set(i, point);
    batch.strengths[0].values[0] = 1.0;
    batch.strengths[2].values[0] = -2.0;
    HatSums sums;
    add_hat_sums(triangle, batch, sums);
    return sums;
}

TEST(TriangleRules, AreExactToTheirDegree) {
    // The mean of the shares' product a^i b^j over a triangle is 2 i! j! / (i + j + 2)!.
    const auto check = [](const std::vector<RulePoint>& rule, int degree) {
        for (int i = 0; i <= degree; ++i) {
            for (int j = 0; i + j <= degree; ++j) {
                double sum = 0.0;
                for (const RulePoint& point : rule) {
                    sum += point.weight * std::pow(point.corner_shares[0], i) *
                           std::pow(point.corner_shares[1], j);
                }
                const double exact = 2.0 * std::tgamma(i + 1) * std::tgamma(j + 1) / std::tgamma(i + j + 3);
                EXPECT_NEAR(sum, exact, 1e-14) << rule.size() << " points, " << i << ", " << j;
            }
        }
    };
    check(symmetric_rule(2), 2);
    check(symmetric_rule(4), 4);
    check(symmetric_rule(6), 6);
    check(symmetric_rule(8), 8);
}

TEST(UniformPotential, AtTheCentreOfAnEquilateralTriangleIsExact) {
    // Six right triangles of leg 1 / (2 sqrt(3)) and angle pi/3: leg x arcosh(2) each.
    const FlatTriangle triangle =
        flat_triangle({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.5, std::sqrt(0.75), 0.0});
    EXPECT_NEAR(potential_at(triangle, triangle.centroid), 3.0 / std::sqrt(3.0) * std::acosh(2.0), 1e-14);
}

TEST(UniformPotential, AgreesWithQuadratureAndIsFiniteOnEdgesAndCorners) {
    const FlatTriangle triangle = common_triangle();
    for (const Vector3d& point :
         {Vector3d(0.4, 0.3, 0.5), Vector3d(-0.6, 0.1, -0.2), Vector3d(3.0, 2.0, 1.0)}) {
        const double expected = triangle.area * mean_over(triangle, 20, [&](const Vector3d& y) {
                                    return 1.0 / (y - point).norm();
                                });
        EXPECT_NEAR(potential_at(triangle, point), expected, 1e-10 * expected);
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector3d& corner = triangle.corners[k];
        const Vector3d middle = 0.5 * (corner + triangle.corners[(k + 1) % 3]);
        const Vector3d inside = 1e-9 * triangle.centroid;
        EXPECT_NEAR(potential_at(triangle, corner), potential_at(triangle, (1.0 - 1e-9) * corner + inside),
                    1e-7);
        EXPECT_NEAR(potential_at(triangle, middle), potential_at(triangle, (1.0 - 1e-9) * middle + inside),
                    1e-7);
    }
}

TEST(HatSums, AddUpToTheUniformPotentialAndTheSolidAngle) {
    // An eighth of the sphere.
    const FlatTriangle triangle = flat_triangle({1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0});
    const HatSums sums = hat_sums(triangle, Vector3d::Zero());
    EXPECT_NEAR(sums.solid_angles.col(0).sum(), 0.5 * pi, 1e-14);
    EXPECT_NEAR(sums.solid_angles.col(2).sum(), -pi, 1e-14);
    EXPECT_EQ(sums.solid_angles.col(1).norm(), 0.0);
    EXPECT_NEAR(sums.potentials.col(0).sum(), potential_at(triangle, Vector3d::Zero()), 1e-14);
    for (Eigen::Index k = 0; k < 3; ++k) EXPECT_NEAR(sums.solid_angles(k, 0), pi / 6.0, 1e-14);
}

TEST(HatSums, AgreeWithQuadratureOnBothSides) {
    const FlatTriangle triangle = common_triangle();
    for (const Vector3d& point :
         {Vector3d(0.4, 0.3, 0.5), Vector3d(-0.6, 0.1, -0.3), Vector3d(1.5, 0.7, 0.4)}) {
        const HatSums sums = hat_sums(triangle, point);
        for (std::size_t k = 0; k < 3; ++k) {
            const double potential = triangle.area * mean_over(triangle, 20, [&](const Vector3d& y) {
                                         return hat(triangle, k, y) / (y - point).norm();
                                     });
            const double angle = triangle.area * mean_over(triangle, 20, [&](const Vector3d& y) {
                                     const double distance = (y - point).norm();
                                     return hat(triangle, k, y) * triangle.normal.dot(y - point) /
                                            (distance * distance * distance);
                                 });
            EXPECT_NEAR(sums.potentials(static_cast<Eigen::Index>(k), 0), potential, 1e-9);
            EXPECT_NEAR(sums.solid_angles(static_cast<Eigen::Index>(k), 0), angle, 1e-9);
        }
    }
}

TEST(PairPotential, OfAUnitSquareWithItselfIsTheClosedForm) {
    // 4 (ln(1 + sqrt 2) + (1 - sqrt 2) / 3), from two triangles that share the diagonal.
    const FlatTriangle a = flat_triangle({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0});
    const FlatTriangle b = flat_triangle({0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0});
    const double exact = 4.0 * (std::log(1.0 + std::sqrt(2.0)) + (1.0 - std::sqrt(2.0)) / 3.0);
    EXPECT_NEAR(2.0 * self_potential(a) + 2.0 * pair_potential(a, b), exact, 1e-8 * exact);
}

TEST(PairPotential, OfATriangleWithItselfIsTheClosedForm) {
    for (const double height : {0.8, 1e-2, 1e-4}) {
        const FlatTriangle triangle = flat_triangle({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.3, height, 0.0});
        EXPECT_NEAR(pair_potential(triangle, triangle) / self_potential(triangle), 1.0, 1e-6) << height;
    }
}

TEST(PairPotential, AgreesWithQuadratureInEveryPosition) {
    const FlatTriangle first = common_triangle();
    const auto edge_neighbour = [](double angle) {
        return flat_triangle({1.0, 0.0, 0.0}, {0.0, 0.0, 0.0},
                             {0.4, 0.7 * std::cos(angle), -0.7 * std::sin(angle)});
    };
    const auto facing = [](double height, double tilt) {
        return flat_triangle({0.2, 0.1, height - tilt}, {0.1, 0.9, height + tilt}, {1.1, 0.2, height});
    };
    const struct {
        const char* name;
        FlatTriangle second;
        double tolerance;  // what the outer quadrature is good to
    } pairs[] = {
        {"coplanar edge neighbours", edge_neighbour(pi), 1e-5},
        {"square edge neighbours", edge_neighbour(0.5 * pi), 1e-6},
        {"sharp edge neighbours", edge_neighbour(0.1), 1e-5},
        {"edge neighbours almost in a plane", edge_neighbour(pi - 1e-6), 1e-5},
        {"corner neighbours", flat_triangle({0.0, 0.0, 0.0}, {-0.5, -0.1, 0.3}, {-0.2, -0.8, 0.1}), 1e-7},
        {"coplanar, a gap apart", flat_triangle({0.0, -0.1, 0.0}, {0.4, -0.9, 0.0}, {1.0, -0.1, 0.0}), 1e-8},
        {"parallel, far", facing(0.5, 0.0), 1e-10},
        {"parallel, near", facing(1e-2, 0.0), 1e-7},
        {"parallel, very near", facing(1e-4, 0.0), 1e-7},
        {"tilted", facing(1e-2, 5e-3), 1e-7},
        {"hardly tilted", facing(1e-1, 1e-7), 1e-7},
        {"skew", flat_triangle({2.0, 0.0, 0.0}, {2.5, 1.0, 0.5}, {2.0, 0.4, 1.0}), 1e-9},
        {"skew, a large one", flat_triangle({1.2, 0.0, -30.0}, {1.2, 0.0, 30.0}, {40.0, 1.0, 0.0}), 1e-8},
    };
    for (const auto& [name, second, tolerance] : pairs) {
        const double value = pair_potential(first, second);
        EXPECT_NEAR(value / by_quadrature(first, second, 250), 1.0, tolerance) << name;
        EXPECT_NEAR(value / pair_potential(second, first), 1.0, 1e-7) << name;
    }
}

TEST(PairPotential, OfSliversOnARimIsGoodToAMillionth) {
    const FlatTriangle face = common_triangle();
    for (const double thickness : {1e-2, 1e-3, 1e-4}) {
        const FlatTriangle rim = flat_triangle({1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {1.0, 0.0, -thickness});
        const FlatTriangle other =
            flat_triangle({1.0, 0.0, -thickness}, {0.0, 0.0, 0.0}, {0.0, 0.0, -thickness});
        // The face's potential hardly changes across the rim, so that few points there suffice.
        EXPECT_NEAR(pair_potential(face, rim) / by_quadrature(rim, face, 300), 1.0, 1e-6) << thickness;
        EXPECT_NEAR(pair_potential(rim, other) / by_quadrature(rim, other, 300), 1.0, 1e-5) << thickness;
    }
}

TEST(PairPotential, DoesNotJumpWhereTheFormulaChanges) {
    // From planes that intersect far away to planes that count as parallel.
    const FlatTriangle first = common_triangle();
    const auto facing = [&](double tilt) {
        return pair_potential(first,
                              flat_triangle({0.2, 0.1, 0.1 - tilt}, {0.1, 0.9, 0.1 + tilt}, {1.1, 0.2, 0.1}));
    };
    const double flat = facing(0.0);
    for (double tilt = 1e-3; tilt > 1e-9; tilt *= 0.3) {
        EXPECT_NEAR(facing(tilt) / flat, 1.0, 0.5 * tilt + 2e-7) << tilt;
    }
}

TEST(PairPotential, ScalesWithTheCubeOfTheSize) {
    const FlatTriangle a = common_triangle();
    const FlatTriangle b = flat_triangle({0.2, 0.1, 0.1}, {0.1, 0.9, 0.1}, {1.1, 0.2, 0.12});
    const auto scaled = [](const FlatTriangle& triangle, double scale) {
        return flat_triangle(scale * triangle.corners[0], scale * triangle.corners[1],
                             scale * triangle.corners[2]);
    };
    for (const double scale : {1e-3, 1e3}) {
        const double expected = scale * scale * scale * pair_potential(a, b);
        EXPECT_NEAR(pair_potential(scaled(a, scale), scaled(b, scale)), expected, 1e-9 * expected);
    }
}

TEST(FlatTriangles, AreRefusedWithoutAnAreaOrFinitePlace) {
    Surface surface;
    surface.vertices = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {0.0, NAN, 0.0}};
    surface.corners = {{0, 1, 2}};
    EXPECT_ANY_THROW(flat_triangles(surface));
    surface.corners = {{0, 1, 3}};
    EXPECT_ANY_THROW(flat_triangles(surface));
}

/// Restores the choice of instructions at the end.
struct AllInstructionsAgain {
    ~AllInstructionsAgain() { hwy::SetSupportedTargetsForTest(0); }
};

TEST(InstructionSets, AgreeOnAllIntegrals) {
    const AllInstructionsAgain restore;
    const FlatTriangle first = common_triangle();
    const FlatTriangle second = flat_triangle({0.2, 0.1, 0.1}, {0.1, 0.9, 0.1}, {1.1, 0.2, 0.12});
    std::vector<FlatTriangle> triangles;
    for (int i = 0; i < 21; ++i) {
        const Vector3d shift(1.0 * i, 0.3 * i, 0.1 * i);
        triangles.push_back(
            flat_triangle(first.corners[0] + shift, first.corners[1] + shift, first.corners[2] + shift));
    }
    const SingleLayerEntries entries(triangles);
    const double potential = potential_at(first, {0.4, 0.3, 0.5});
    const double pair = pair_potential(first, second);
    const HatSums sums = hat_sums(first, {0.4, 0.3, -0.5});
    std::vector<double> row(21);
    entries.fill_row(3, 0, 21, row.data());
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        const char* name = hwy::TargetName(target);
        EXPECT_NEAR(potential_at(first, {0.4, 0.3, 0.5}) / potential, 1.0, 1e-13) << name;
        EXPECT_NEAR(pair_potential(first, second) / pair, 1.0, 1e-12) << name;
        const HatSums again = hat_sums(first, {0.4, 0.3, -0.5});
        EXPECT_LT((again.solid_angles - sums.solid_angles).norm(), 1e-13) << name;
        EXPECT_LT((again.potentials - sums.potentials).norm(), 1e-13) << name;
        std::vector<double> again_row(21);
        entries.fill_row(3, 0, 21, again_row.data());
        // Rules are chosen for a register at once.
        for (std::size_t j = 0; j < 21; ++j)
            EXPECT_NEAR(again_row[j] / row[j], 1.0, 1e-5) << name << " " << j;
    }
}

}  // namespace
}  // namespace samara
