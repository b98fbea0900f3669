#pragma once

#include <vector>

#include "samara/kirchhoff/panels.hpp"

namespace samara {

/// How all the panels act on one collocation point, the centroid of one of them.
class InfluenceRow {
  public:
    explicit InfluenceRow(const Panels& panels);

    /// Takes the centroid of panel `index` as the point.
    void move_to(std::size_t index);

    /// -D for panel j: the integral of (y - x).n / (4 pi |y - x|^3), the share of the full solid angle under
    /// which the panel is seen, positive where its inner side is seen; 0 for the point's own panel.
    /// van Oosterom and Strackee, IEEE Trans. Biomed. Eng. BME-30(2), 1983, equation 8.
    [[nodiscard]] double solid_angle_share(std::size_t j) const;

    /// S for panel j: the integral of 1 / (4 pi |y - x|) over it. Exact within four radii of the panel
    /// (Wilton et al., IEEE Trans. Antennas Propag. AP-32(3), 1984, equation 5); beyond, by the panel's area
    /// and second moments, with an error below (radius / distance)^3 of it. `solid_angle_share` is that of
    /// panel j.
    [[nodiscard]] double source_potential(std::size_t j, double solid_angle_share) const;

  private:
    [[nodiscard]] double near_integral(const Panel& panel, double solid_angle_share) const;

    const Panels& panels_;
    std::size_t own_ = 0;
    std::vector<Vector3d> arms_;     // from the point to each vertex
    std::vector<double> distances_;  // their lengths
};

}  // namespace samara
