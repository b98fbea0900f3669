#include "samara/kirchhoff/influence.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "samara/kirchhoff/panels.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

/// The mean of f over the triangle, by its division into n^2 and the value in the middle of each.
template <typename Function>
double mean_over(const Vector3d& a, const Vector3d& b, const Vector3d& c, int n, const Function& f) {
    double sum = 0.0;
    const Vector3d u = (b - a) / n;
    const Vector3d v = (c - a) / n;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; i + j < n; ++j) {
            sum += f(Vector3d(a + (i + 1.0 / 3.0) * u + (j + 1.0 / 3.0) * v));
            if (i + j < n - 1) sum += f(Vector3d(a + (i + 2.0 / 3.0) * u + (j + 2.0 / 3.0) * v));
        }
    }
    return sum / (n * n);
}

TEST(Influence, SolidAnglesSeenFromAPanelOfAClosedSurfaceAreHalfTheFullOne) {
    const Panels panels = make_panels(test::ellipsoid({1.0, 2.0, 0.1}, 2), Vector3d::Zero(), 1.0);
    InfluenceRow row(panels);
    for (const std::size_t i : {0U, 100U, 319U}) {
        row.move_to(i);
        double sum = 0.0;
        for (std::size_t j = 0; j < panels.panels.size(); ++j) sum += row.solid_angle_share(j);
        EXPECT_NEAR(sum, 0.5, 1e-13);
    }
}

TEST(Influence, PanelsOfACubeSeenFromOneFaceHaveTheSignOfTheirInnerSide) {
    const Panels panels = make_panels(test::box({1.0, 1.0, 1.0}, 1), Vector3d::Zero(), 1.0);
    InfluenceRow row(panels);
    row.move_to(0);
    for (std::size_t j = 0; j < panels.panels.size(); ++j) EXPECT_GE(row.solid_angle_share(j), 0.0);
}

TEST(Influence, AgreesWithQuadratureNearAndFar) {
    const Panels panels = make_panels(test::ellipsoid({1.0, 1.5, 0.6}, 2), Vector3d::Zero(), 1.0);
    InfluenceRow row(panels);
    row.move_to(5);
    const Vector3d point = panels.panels[5].centroid;
    for (std::size_t j = 0; j < panels.panels.size(); ++j) {
        if (j == 5) continue;
        const Panel& panel = panels.panels[j];
        const auto vertex = [&](std::size_t i) {
            return panels.vertices[static_cast<std::size_t>(panel.corners[i])];
        };
        const auto integral = [&](const auto& f) {
            return panel.area / (4.0 * std::numbers::pi) * mean_over(vertex(0), vertex(1), vertex(2), 60, f);
        };
        const double solid_angle = integral([&](const Vector3d& y) {
            return (y - point).dot(panel.normal) / std::pow((y - point).norm(), 3);
        });
        const double potential = integral([&](const Vector3d& y) { return 1.0 / (y - point).norm(); });
        const double share = row.solid_angle_share(j);
        EXPECT_NEAR(share, solid_angle, 1e-3 * std::abs(solid_angle) + 1e-7);
        EXPECT_NEAR(row.source_potential(j, share), potential, 1e-3 * potential);
    }
}

TEST(Influence, OwnPotentialOfAnEquilateralTriangleIsExact) {
    // The integral of 1/r over an equilateral triangle of edge a from its centroid is a sqrt(3) arcosh(2):
    // six right triangles of leg a / (2 sqrt(3)) and angle pi/3, each leg * ln(sec + tan) = leg * arcosh(2).
    Surface surface = test::icosphere(0);
    const Panels panels = make_panels(surface, Vector3d::Zero(), 1.0);
    const auto& corners = panels.panels[0].corners;
    const double edge = (panels.vertices[static_cast<std::size_t>(corners[0])] -
                         panels.vertices[static_cast<std::size_t>(corners[1])])
                            .norm();
    InfluenceRow row(panels);
    row.move_to(0);
    const double exact = 6.0 * edge / (2.0 * std::sqrt(3.0)) * std::acosh(2.0) / (4.0 * std::numbers::pi);
    EXPECT_NEAR(row.source_potential(0, 0.0), exact, 1e-14);
}

}  // namespace
}  // namespace samara
