#pragma once

namespace samara {

/// How a body's own wake makes its loads fluctuate: as if it met the flow with a slip, of which each
/// component across the path has this rms over the body's speed |w|, that along it this rms over the root of
/// 2k/3, and which lasts so many L/|w|. Where k is zero the flow is laminar, and does not fluctuate. Measured
/// on a sphere and a disc (docs/noise.md).
inline constexpr double wake_across = 0.05;
inline constexpr double wake_along = 0.5;
inline constexpr double wake_persistence = 2.5;

}  // namespace samara
