#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "samara/core/body/body.hpp"

namespace samara {

/// Returns the data of a picture of a body's tables, as draw_picture() takes it: "polars" (coefficients and
/// their standard errors against the angle in the planes of the principal axes), "sphere" (over a grid of
/// latitudes and longitudes about the shortest axis, with the longest in the middle) or "convergence" (over
/// meshes, sources of errors and Reynolds numbers). At the Reynolds number of most cases. Throws Error where
/// the body has no tables.
nlohmann::json body_picture(const std::string& picture, const Body& body);

}  // namespace samara
