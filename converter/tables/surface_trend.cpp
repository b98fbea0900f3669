#include "converter/tables/surface_trend.hpp"

#include "converter/tables/direction_sampling.hpp"
#include "converter/tables/symmetric_loads.hpp"

namespace samara {

SurfaceTrend::SurfaceTrend(const SurfaceLoads& loads, const Symmetry& symmetry, double reynolds_number)
    : tables_(as_tables(loads, 1.0)), reynolds_number_(reynolds_number) {
    for (const Matrix3d& element : elements_in_map_axes(symmetry)) {
        elements_.push_back(symmetry.axes * element);
    }
}

LoadEntry SurfaceTrend::at(const Vector3d& direction) const {
    LoadEntry mean;
    const double part = 1.0 / static_cast<double>(elements_.size());
    for (const Matrix3d& element : elements_) {
        const LoadEntry image = look_up(tables_, element * direction, reynolds_number_);
        mean = plus(mean, part, transformed(image, element.transpose()));
    }
    return mean;
}

}  // namespace samara
