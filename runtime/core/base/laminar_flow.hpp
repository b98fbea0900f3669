#pragma once

namespace samara {

/// The largest Reynolds number at which the flow around a blunt body is still free of turbulence, so that the
/// k-epsilon model does not hold: some 300 for a sphere's wake (Johnson & Patel, J. Fluid Mech. 378, 1999).
/// Cases below it are baked as laminar, and fly without turbulence.
inline constexpr double laminar_reynolds_number = 300.0;

}  // namespace samara
