#pragma once

#include <cctype>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "samara/core/surface/display_mesh.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// Makes names of prims: letters, digits and underscores, each name once.
class PrimNames {
  public:
    std::string operator()(const std::string& name) {
        std::string prim = name;
        for (char& letter : prim) {
            if (std::isalnum(static_cast<unsigned char>(letter)) == 0) letter = '_';
        }
        if (prim.empty() || std::isdigit(static_cast<unsigned char>(prim.front())) != 0) prim = "_" + prim;
        std::string unused = prim;
        for (int i = 1; !used_.insert(unused).second; ++i) unused = fmt::format("{}_{}", prim, i);
        return unused;
    }

  private:
    std::set<std::string> used_;
};

/// Returns a number as USD's text has it: the shortest that reads back as the same float.
std::string usd_float(double value);

/// Returns a vector as USD's text has it, (x, y, z) of floats.
std::string usd_float3(const Vector3d& vector);

/// Returns the Mesh prim "mesh" of a surface, its lines indented by `indent` spaces: welded points,
/// triangles, normals (at the points of a smooth surface, at the triangles' corners where there are creases),
/// no subdivision. `grey`: its colour, from 0 to 1, or none, where it takes that of the prims above it;
/// `double_sided`: seen from behind, too.
std::string usd_mesh(const Surface& surface, std::size_t indent, const std::optional<double>& grey = 0.8,
                     bool double_sided = false);

/// Returns the Mesh prim "mesh" of a display mesh with its texture coordinates (primvars:st), a subset of
/// faces for each of its materials in use, and these beside it. `image_files`: where its images are, from the
/// stage's folder.
std::string usd_display(const DisplayMesh& display, const std::vector<std::string>& image_files,
                        std::size_t indent);

}  // namespace samara
