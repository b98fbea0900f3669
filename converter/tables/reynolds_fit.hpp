#pragma once

#include <optional>
#include <vector>

#include "converter/tables/direction_fit.hpp"
#include "converter/tables/symmetric_loads.hpp"
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

/// One standard error for all components of a force or moment alike; those of k and epsilon are of their
/// natural logarithms.
struct ErrorMetrics {
    double force = 0.0;
    double moment = 0.0;
    double turbulent_kinetic_energy = 0.0;
    double dissipation_rate = 0.0;
};

/// The entry with the natural logarithms of k and epsilon. Where either is 0 (laminar flow) both become 0.
LoadEntry in_logarithms(const LoadEntry& entry);

/// Whether k and epsilon are positive.
bool is_turbulent(const LoadEntry& entry);

/// The loads over the direction at one Reynolds number: a smooth function through its samples (map axes).
/// Forces and moments are interpolated as they are, k and epsilon by their logarithms, so that they stay
/// positive; in laminar flow they are 0 everywhere. Beside another, denser fit (`main`, at another Reynolds
/// number or on a coarser mesh) it is main's value that stands, plus a smooth interpolation of the samples'
/// differences from it: few samples then give a whole table. Likewise force and moment, each where leaving
/// out each sample in turn halves the variance of its errors so, may stand beside the body's trend by its
/// surface.
class ReynoldsFit {
  public:
    /// `samples` already passed through keep_symmetric_part, at least one; no two directions are images of
    /// each other. `main` must outlive the fit. Throws Error where laminar and turbulent samples are mixed.
    ReynoldsFit(const Symmetry& symmetry, const std::vector<DirectionSample>& samples,
                const ReynoldsFit* main);

    /// The same of the main fit itself, beside the trend where there is one.
    ReynoldsFit(const Symmetry& symmetry, const std::vector<DirectionSample>& samples,
                std::optional<SurfaceTrend> trend);

    /// The entry in a direction.
    [[nodiscard]] LoadEntry at(const Vector3d& direction) const;

    /// The standard error of `at` from the interpolation alone. The interpolation's spread
    /// (DirectionFit::spread) is scaled by leaving each sample out and predicting it from the others: the
    /// mean square of (error / spread) over the samples, for each allowed component, widened for their small
    /// number (student_widening). Beside a main fit, its errors and those of the differences in quadrature.
    [[nodiscard]] ErrorMetrics interpolation_error(const Vector3d& direction) const;

    /// The standard errors of samples as they stand in a direction (DirectionFit::error_at).
    [[nodiscard]] LoadEntryError error_at(const std::vector<LoadEntryError>& errors,
                                          const Vector3d& direction) const {
        return fit_.error_at(errors, direction);
    }

    [[nodiscard]] bool turbulent() const { return turbulent_; }

    /// Whether force and moment stand beside the trend.
    [[nodiscard]] bool force_has_trend() const { return force_has_trend_; }
    [[nodiscard]] bool moment_has_trend() const { return moment_has_trend_; }

  private:
    [[nodiscard]] LoadEntry logarithms_at(const Vector3d& direction) const;
    /// Main's value or the trend's, of what stands beside it.
    [[nodiscard]] LoadEntry beside(const Vector3d& direction) const;
    void set_values(const std::vector<DirectionSample>& samples);
    /// The errors per spread that leaving out each sample tells of the values.
    [[nodiscard]] ErrorMetrics left_out(const Symmetry& symmetry,
                                        const std::vector<DirectionSample>& samples) const;

    DirectionFit fit_;
    std::vector<LoadEntry> values_;  ///< in logarithms; differences from what is beside
    ErrorMetrics scale_;             ///< of the error per spread
    const ReynoldsFit* main_ = nullptr;
    std::optional<SurfaceTrend> trend_;
    bool force_has_trend_ = false;
    bool moment_has_trend_ = false;
    bool turbulent_;
};

}  // namespace samara
