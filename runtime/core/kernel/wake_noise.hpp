#pragma once

namespace samara {

/// How a body's own wake makes its loads fluctuate: as if it met the flow with a slip, of which each
/// component has this rms over the root of 2k/3, and which lasts so many L/|w|. Where k is zero the flow is
/// laminar, and does not fluctuate. And the pressure of what sheds pushes on the body's sides: a force across
/// the path of rho |w|/2 times the slip, times the body's projected area in the force's direction, times
/// this. Measured on a sphere, a disc, an ellipsoid and a sheet that are held (docs/studies/noise).
inline constexpr double wake_fluctuation_share = 0.3;
inline constexpr double wake_side_pressure = 1.15;
inline constexpr double wake_persistence = 2.5;

/// A body that turns sheds by its turns: the slip's rms goes as w^2 / (w^2 + (this L omega)^2). Chosen by
/// ensembles of falls of two discs (docs/studies/noise).
inline constexpr double wake_order = 4.0;

/// C_k of the paper's eq. 7; Pope, Phys. Fluids 26 (1983).
inline constexpr double kolmogorov_constant = 2.1;

}  // namespace samara
