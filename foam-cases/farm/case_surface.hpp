#pragma once

#include <string>

#include "foam-cases/bake/bake_plan.hpp"

namespace samara {

/// The body's surface in case axes as an ASCII STL file of one solid, "body". Triangles of order 2 become
/// four flat ones, so that the mesh sees the curved surface's edge nodes.
std::string case_surface_stl(const Body& body, const BakePlan& plan);

}  // namespace samara
