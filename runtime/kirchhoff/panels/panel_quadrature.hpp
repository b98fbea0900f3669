#pragma once

#include <cstddef>
#include <vector>

#include "samara/kirchhoff/panels/panel_kernels.hpp"

namespace samara {

/// The effect of one panel at one node: the integrals of (y - x).n f_a / (4 pi r^3) for its six node
/// functions f_a, and of y cross n / (4 pi r).
struct PanelIntegrals {
    std::array<double, 6> double_layer;
    Vector3d potential;
};

/// Integrates panels to a wanted relative accuracy: by few points in single precision where they are
/// far from a node, by more in double where they are near, by ever smaller pieces of the panel where they are
/// very near, and by rays from the node on the panels that it belongs to.
///
/// Whether a rule is enough depends on the distance from the panel's centre in radii of the panel: the error
/// of a rule of degree d falls as the power d + 1 of that ratio.
class PanelQuadrature {
  public:
    /// Chooses rules for integrals with errors of about `tolerance` of the panel's part.
    PanelQuadrature(const std::vector<CurvedPanel>& panels, double tolerance, int threads);

    /// Returns the radius that ratios are relative to: the panel's, or more where it is bent.
    [[nodiscard]] static double effective_radius(const CurvedPanel& panel);
    /// Returns the least distance of a node, in effective radii of the panel, for which far_sources() are
    /// enough.
    [[nodiscard]] double far_ratio() const { return far_ratio_; }
    [[nodiscard]] const SourcePoints<float>& far_sources() const { return far_; }

    /// Returns the least squared ratio of distance to effective radius for which near_sources() are enough;
    /// nearer panels must be cut in pieces.
    [[nodiscard]] double least_squared_ratio() const { return whole_.back().squared_ratio; }
    /// Returns the fewest points in double precision that are enough at this squared ratio.
    [[nodiscard]] const SourcePoints<double>& near_sources(double squared_ratio) const;

    /// Returns the integrals over a panel that the node does not belong to, however near it is.
    [[nodiscard]] PanelIntegrals near_integrals(const CurvedPanel& panel, const Vector3d& node) const;

    /// Returns the integrals over a panel as seen from its own node `own`, 0 to 5.
    [[nodiscard]] PanelIntegrals own_integrals(const CurvedPanel& panel, std::size_t own) const;

  private:
    template <typename Rule>
    struct Step {
        double squared_ratio;  // from which the rule is enough
        Rule rule;
    };

    void add_near(const CurvedPanel& panel, const std::array<std::array<double, 2>, 3>& corners,
                  const std::array<Vector3d, 3>& places, const Vector3d& node, int depth,
                  PolynomialSums& sums) const;
    void add_rays(const CurvedPanel& panel, const std::array<std::array<double, 2>, 3>& corners,
                  const std::array<Vector3d, 3>& places, int depth, PolynomialSums& sums) const;

    double far_ratio_;
    SourcePoints<float> far_;
    std::vector<Step<SourcePoints<double>>> whole_;  // panels; the fewest points first
    std::vector<Step<TriangleRule>> pieces_;
    TriangleRule rays_;
};

}  // namespace samara
