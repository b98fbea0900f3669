#pragma once

#include <array>
#include <vector>

#include "samara/kirchhoff/panels/flat_triangle.hpp"

namespace samara {

/// The entries of the single-layer matrix V of constant densities on flat triangles,
/// V_ij = double integral of 1 / (4 pi r) over the triangles i and j: symmetric and positive definite.
///
/// Near pairs are integrated to about 1e-8 of the entry (pair_potential); distant ones by products of rules
/// with 12, 6 or 3 points a triangle in single precision, whose relative error stays below about 1e-6.
class SingleLayerEntries {
  public:
    /// Prepares the rules of the triangles. Triangles that follow each other should be neighbours in space:
    /// rules are chosen for several at once.
    explicit SingleLayerEntries(std::vector<FlatTriangle> triangles);

    [[nodiscard]] const std::vector<FlatTriangle>& triangles() const { return triangles_; }
    [[nodiscard]] std::size_t size() const { return triangles_.size(); }

    /// Writes V(row, begin) to V(row, end - 1) to `values`.
    void fill_row(std::size_t row, std::size_t begin, std::size_t end, double* values) const;

    /// The quadrature points of one rule, from the triangle's centroid: coordinate arrays by point, then by
    /// triangle.
    struct RulePoints {
        std::vector<float> weights;  ///< shares of the area
        std::array<std::vector<float>, 3> coordinates;
    };

    /// The triangles as fill_row() reads them, coordinate by coordinate for vector registers; padded beyond
    /// the last triangle.
    struct Arrays {
        std::size_t stride = 0;
        std::array<std::vector<double>, 3> centroid;
        std::vector<float> radius;
        std::vector<float> area;
        std::array<RulePoints, 3> rules;  ///< of 3, 6 and 12 points
    };

  private:
    [[nodiscard]] double near_entry(std::size_t i, std::size_t j) const;

    std::vector<FlatTriangle> triangles_;
    Arrays arrays_;
};

}  // namespace samara
