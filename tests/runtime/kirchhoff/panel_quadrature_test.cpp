#include "samara/kirchhoff/panels/panel_quadrature.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace samara {
namespace {

constexpr double full_solid_angle = 4.0 * std::numbers::pi;

/// One triangle with straight edges.
CurvedPanel flat_panel(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    Surface surface;
    surface.vertices = {a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)};
    surface.corners = {{0, 1, 2}};
    surface.edge_nodes = {{3, 4, 5}};
    return make_curved_panels(surface).panels.front();
}

CurvedPanel moved(CurvedPanel panel, const Vector3d& shift) {
    panel.coefficients[0] += shift;
    panel.centre += shift;
    return panel;
}

/// The share of the full solid angle under which a flat triangle is seen (van Oosterom and Strackee 1983),
/// positive from its inner side.
double solid_angle_share(const CurvedPanel& panel, const Vector3d& node) {
    const Vector3d a = panel.place(0.0, 0.0) - node;
    const Vector3d b = panel.place(1.0, 0.0) - node;
    const Vector3d c = panel.place(0.0, 1.0) - node;
    const double rest =
        a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() + a.dot(c) * b.norm() + b.dot(c) * a.norm();
    return 2.0 * std::atan2(a.dot(b.cross(c)), rest) / full_solid_angle;
}

/// The potential of a flat triangle of density 1 (Wilton et al. 1984, equation 5), over 4 pi.
double uniform_potential(const CurvedPanel& panel, const Vector3d& node) {
    const Vector3d corners[3] = {panel.place(0.0, 0.0), panel.place(1.0, 0.0), panel.place(0.0, 1.0)};
    const Vector3d normal = panel.area_normal(0.0, 0.0).normalized();
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
        const Vector3d from = corners[i] - node;
        const Vector3d to = corners[(i + 1) % 3] - node;
        const Vector3d edge = to - from;
        const double outward = from.dot(edge.cross(normal)) / edge.norm();
        if (std::abs(outward) < 1e-14) continue;
        sum += outward * 2.0 * std::atanh(edge.norm() / (from.norm() + to.norm()));
    }
    const double height = (corners[0] - node).dot(normal);
    return sum / full_solid_angle - height * solid_angle_share(panel, node);
}

double sum_of(const PanelIntegrals& integrals) {
    double sum = 0.0;
    for (const double value : integrals.double_layer) sum += value;
    return sum;
}

/// The potential of density 1 from those of y cross n, by two panels in different places.
double density_one(const Vector3d& potential, const Vector3d& moved_potential, const Vector3d& shift,
                   const CurvedPanel& panel) {
    const Vector3d across = shift.cross(panel.area_normal(0.0, 0.0).normalized());
    return (moved_potential - potential).dot(across) / across.squaredNorm();
}

const Vector3d shift(0.7, -0.4, 0.9);

TEST(PanelQuadrature, GivesTheSolidAngleAndPotentialOfFlatTrianglesHoweverNear) {
    const CurvedPanel panels[2] = {flat_panel({0, 0, 0}, {1, 0.1, 0}, {0.3, 0.8, 0.2}),
                                   flat_panel({0, 0, 0}, {1, 0, 0}, {0.5, 0.01, 0})};
    for (const CurvedPanel& panel : panels) {
        for (const double tolerance : {1e-2, 1e-5, 1e-8}) {
            const PanelQuadrature quadrature({panel}, tolerance, 1);
            const Vector3d normal = panel.area_normal(0.0, 0.0).normalized();
            for (const double height : {1.0, 0.1, -1e-2, 1e-4, -1e-7}) {
                const Vector3d node = panel.place(0.3, 0.25) + height * normal;
                const PanelIntegrals integrals = quadrature.near_integrals(panel, node);
                const PanelIntegrals far_from_origin =
                    quadrature.near_integrals(moved(panel, shift), node + shift);
                EXPECT_NEAR(sum_of(integrals), solid_angle_share(panel, node), 0.1 * tolerance) << height;
                EXPECT_NEAR(density_one(integrals.potential, far_from_origin.potential, shift, panel),
                            uniform_potential(panel, node), 0.1 * tolerance)
                    << height;
            }
        }
    }
}

TEST(PanelQuadrature, GivesThePotentialAtTheNodesOfThePanelItself) {
    const CurvedPanel panels[2] = {flat_panel({0, 0, 0}, {1, 0.1, 0}, {0.3, 0.8, 0.2}),
                                   flat_panel({0, 0, 0}, {1, 0, 0}, {0.5, 0.01, 0})};
    for (const CurvedPanel& panel : panels) {
        const PanelQuadrature quadrature({panel}, 1e-6, 1);
        for (std::size_t own = 0; own < 6; ++own) {
            const Vector3d node = panel.place(node_coordinates[own][0], node_coordinates[own][1]);
            const PanelIntegrals integrals = quadrature.own_integrals(panel, own);
            const PanelIntegrals far_from_origin = quadrature.own_integrals(moved(panel, shift), own);
            EXPECT_NEAR(sum_of(integrals), 0.0, 1e-12);
            EXPECT_NEAR(density_one(integrals.potential, far_from_origin.potential, shift, panel),
                        uniform_potential(panel, node), 1e-8)
                << own;
        }
    }
}

TEST(PanelQuadrature, WeighsTheNodeFunctionsByTheirValues) {
    // Far away, a function's integral is its mean over the panel times the whole: 0 for corners, 1/3 for
    // edges.
    const CurvedPanel panel = flat_panel({0, 0, 0}, {1, 0.1, 0}, {0.3, 0.8, 0.2});
    const PanelQuadrature quadrature({panel}, 1e-6, 1);
    const PanelIntegrals integrals = quadrature.near_integrals(panel, {300.0, -400.0, 500.0});
    const double whole = sum_of(integrals);
    for (std::size_t a = 0; a < 6; ++a) {
        EXPECT_NEAR(integrals.double_layer[a] / whole, a < 3 ? 0.0 : 1.0 / 3.0, 2e-3) << a;
    }
}

TEST(PanelQuadrature, GroupsOfNodesAgreeWithSingleOnes) {
    const CurvedPanel panel = flat_panel({0, 0, 0}, {1, 0.1, 0}, {0.3, 0.8, 0.2});
    const std::vector<CurvedPanel> panels = {panel};
    const PanelQuadrature quadrature(panels, 1e-7, 1);
    NodeGroup<double> group{};
    NodeGroup<float> narrow_group{};
    std::array<double, group_size> share{};
    for (std::size_t i = 0; i < group_size; ++i) {
        group.x[i] = 20.0 + static_cast<double>(i);
        group.y[i] = 5.0 - static_cast<double>(i);
        group.z[i] = 17.0;
        narrow_group.x[i] = static_cast<float>(group.x[i]);
        narrow_group.y[i] = static_cast<float>(group.y[i]);
        narrow_group.z[i] = static_cast<float>(group.z[i]);
        share[i] = i == 3 ? 0.0 : 1.0;
    }
    alignas(64) std::array<float, 6 * group_size> near_rows{};
    alignas(64) std::array<float, 6 * group_size> far_rows{};
    GroupPotentials near_potentials{};
    GroupPotentials far_potentials{};
    add_near_panel(quadrature.near_sources(1e4), panels, 0, group, share, near_rows.data(), near_potentials);
    add_far_panels(quadrature.far_sources(), panels, {0}, narrow_group, far_rows.data(), far_potentials);
    for (std::size_t i = 0; i < group_size; ++i) {
        const PanelIntegrals one = quadrature.near_integrals(panel, {group.x[i], group.y[i], group.z[i]});
        const double scale = std::abs(sum_of(one));
        for (std::size_t a = 0; a < 6; ++a) {
            const std::size_t place = static_cast<std::size_t>(panel.nodes[a]) * group_size + i;
            EXPECT_NEAR(near_rows[place], i == 3 ? 0.0 : one.double_layer[a], 1e-6 * scale);
            EXPECT_NEAR(far_rows[place], one.double_layer[a], 3e-6 * scale);
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const double exact = one.potential[static_cast<Eigen::Index>(k)];
            EXPECT_NEAR(near_potentials[k][i], i == 3 ? 0.0 : exact, 1e-9);
            EXPECT_NEAR(far_potentials[k][i], exact, 1e-8);
        }
    }
}

}  // namespace
}  // namespace samara
