#pragma once

#include <optional>
#include <vector>

#include "converter/tables/direction_fit.hpp"
#include "converter/tables/symmetric_loads.hpp"
#include "samara/core/body/body.hpp"
#include "samara/core/body/surface_loads.hpp"

namespace samara {

/// The loads by a body's potential flow (docs/surface-loads) over the direction, made exactly symmetric: the
/// trend from which a table of few cases is interpolated (ReynoldsFit). Its values may be off by a third;
/// only their change with the direction matters.
class SurfaceTrend {
  public:
    /// Constructs the trend for a finite symmetry at a Reynolds number.
    SurfaceTrend(const SurfaceLoads& loads, const Symmetry& symmetry, double reynolds_number);

    /// Returns force and moment coefficients in a direction, all in map axes; k and epsilon are 0.
    [[nodiscard]] LoadEntry at(const Vector3d& direction) const;

  private:
    LoadTables tables_;
    double reynolds_number_;
    std::vector<Matrix3d> elements_;  ///< from map axes to the body axes of each image
};

/// Standard errors, equal for all components of a force or moment; those of turbulence are in_fit_units().
struct ErrorMetrics {
    double force = 0.0;
    double moment = 0.0;
    double turbulent_kinetic_energy = 0.0;
    double dissipation_rate = 0.0;
};

/// Returns the entry with the units in which turbulence is interpolated and its errors are estimated: the
/// roots of k, which the velocity fluctuation goes with, and of epsilon.
LoadEntry in_fit_units(const LoadEntry& entry);

/// Returns the entry of one in_fit_units(), whose roots are not below those of `least`.
LoadEntry from_fit_units(const LoadEntry& entry, const LoadEntry& least);

/// Whether k and epsilon are positive.
bool is_turbulent(const LoadEntry& entry);

/// The loads over the direction at one Reynolds number: a smooth function through its samples (map axes).
/// Forces and moments are interpolated as they are, turbulence in_fit_units(), its roots never below half of
/// the least sample's; in laminar flow k and epsilon are 0 everywhere. Relative to another, denser fit
/// (`main`, at another Reynolds number or on a coarser mesh) the value is main's plus a smooth interpolation
/// of the samples' differences from it, so that few samples give a whole table. Likewise force and moment may
/// each be relative to the trend by the body's surface loads, where that halves the variance of the
/// leave-one-out errors.
class ReynoldsFit {
  public:
    /// `samples` already passed through keep_symmetric_part, at least one; no two directions are images of
    /// each other. `main` must outlive the fit. Throws Error where laminar and turbulent samples are mixed.
    ReynoldsFit(const Symmetry& symmetry, const std::vector<DirectionSample>& samples,
                const ReynoldsFit* main);

    /// Constructs the main fit, relative to the trend where one is given.
    ReynoldsFit(const Symmetry& symmetry, const std::vector<DirectionSample>& samples,
                std::optional<SurfaceTrend> trend);

    /// Returns the entry in a direction.
    [[nodiscard]] LoadEntry at(const Vector3d& direction) const;

    /// Returns the standard error of `at` by the interpolation alone. The interpolation's spread
    /// (DirectionFit::spread) is scaled by leave-one-out errors: the mean square of (error / spread) over the
    /// samples, for each allowed component, widened for their small number (student_widening). Relative to a
    /// main fit, its errors and those of the differences are added in quadrature.
    [[nodiscard]] ErrorMetrics interpolation_error(const Vector3d& direction) const;

    /// Returns the standard errors of samples in a direction (DirectionFit::error_at).
    [[nodiscard]] LoadEntryError error_at(const std::vector<LoadEntryError>& errors,
                                          const Vector3d& direction) const {
        return fit_.error_at(errors, direction);
    }

    [[nodiscard]] bool turbulent() const { return turbulent_; }

    /// Whether force and moment are relative to the trend.
    [[nodiscard]] bool force_has_trend() const { return force_has_trend_; }
    [[nodiscard]] bool moment_has_trend() const { return moment_has_trend_; }

  private:
    [[nodiscard]] LoadEntry in_fit_units_at(const Vector3d& direction) const;
    /// Returns the value of main or of the trend to which the samples are relative.
    [[nodiscard]] LoadEntry base_at(const Vector3d& direction) const;
    void set_values(const std::vector<DirectionSample>& samples);
    /// Returns the leave-one-out errors per spread.
    [[nodiscard]] ErrorMetrics left_out(const Symmetry& symmetry,
                                        const std::vector<DirectionSample>& samples) const;

    DirectionFit fit_;
    std::vector<LoadEntry> values_;  ///< in_fit_units(); differences from base_at()
    ErrorMetrics scale_;             ///< error per spread
    const ReynoldsFit* main_ = nullptr;
    std::optional<SurfaceTrend> trend_;
    bool force_has_trend_ = false;
    bool moment_has_trend_ = false;
    bool turbulent_;
    LoadEntry least_;  ///< half of the samples' least roots
};

}  // namespace samara
