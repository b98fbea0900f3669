#pragma once

#include <vector>

#include "samara/core/body/body.hpp"
#include "samara/core/body/surface_loads.hpp"

namespace samara {

/// The loads of a body's potential flow (docs/surface-loads) over the direction, made exactly symmetric: what
/// a table of few cases is interpolated beside (ReynoldsFit). Its levels may be a third off; what counts is
/// how they change with the direction.
class SurfaceTrend {
  public:
    /// Of a finite symmetry, at a Reynolds number.
    SurfaceTrend(const SurfaceLoads& loads, const Symmetry& symmetry, double reynolds_number);

    /// Force and moment as the tables' in a direction, all in map axes; k and epsilon are 0.
    [[nodiscard]] LoadEntry at(const Vector3d& direction) const;

  private:
    LoadTables tables_;
    double reynolds_number_;
    std::vector<Matrix3d> elements_;  ///< from map axes to the body axes of each image
};

}  // namespace samara
