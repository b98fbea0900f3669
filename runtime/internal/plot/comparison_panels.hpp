#pragma once

#include "samara/analysis/comparison/comparison.hpp"
#include "samara/internal/plot/canvas.hpp"
#include "samara/internal/plot/panel.hpp"

namespace samara {

/// The colours of a comparison's two sides (Okabe and Ito's palette), and of its other falls.
inline constexpr unsigned motion_color = 0x0072b2;
inline constexpr unsigned reference_color = 0xd55e00;
inline constexpr unsigned faint_motion_color = 0xbcd8ea;
inline constexpr unsigned faint_reference_color = 0xf5d3b8;

/// Until when falls are drawn (s since the release): what both cover, 24 swings of the reference at most.
double drawn_time(const Comparison& comparison);

/// Both paths in two views; between the two edges (pixels).
PanelText path_panel(const Comparison& comparison, double left, double right);

/// The inclination over time.
PanelText inclination_panel(const Comparison& comparison, const Box& box);

/// The spectra of the swings.
PanelText spectrum_panel(const Comparison& comparison, const Box& box);

/// The distribution functions of the inclination.
PanelText distribution_panel(const Comparison& comparison, const Box& box);

}  // namespace samara
