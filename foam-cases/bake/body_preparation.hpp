#pragma once

#include <filesystem>

#include "samara/core/body/body.hpp"

namespace samara {

/// The body of a shape file, meshed by the program samara-mesh with its defaults, or of a body file, read as
/// it is. `scale`: metres for one unit of the shape file; a body file takes none but 1. `folder` receives
/// what is made on the way (shape.body.h5, log.mesh). Throws Error.
Body prepare_body(const std::filesystem::path& shape, double scale, const std::filesystem::path& folder);

/// Gives the body its Kirchhoff tensor where it has none: the one of the body file `earlier` where there is
/// such a file of the same surface, else by the command `samara kirchhoff`, for which `folder` receives what
/// is made on the way. Throws Error, which names `shape`, the file that the body was made of.
void add_kirchhoff_tensor(Body& body, const std::filesystem::path& shape,
                          const std::filesystem::path& earlier, const std::filesystem::path& folder);

}  // namespace samara
