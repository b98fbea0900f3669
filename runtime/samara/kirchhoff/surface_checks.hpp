#pragma once

#include <string>

#include "samara/body/surface.hpp"

namespace samara {

/// The volume (m^3) inside the flat corner triangles; negative where they face inwards.
double signed_volume(const Surface& surface);

/// In words, what is wrong with a surface that is not closed, outward and free of repeated triangles; empty
/// where its edges show no fault. Vertices at the same place count as one.
std::string edge_fault(const Surface& surface);

/// Whether two flat triangles that share an edge turn by more than `angle` (radians) there.
bool has_creases(const Surface& surface, double angle);

}  // namespace samara
