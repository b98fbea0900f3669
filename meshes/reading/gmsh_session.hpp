#pragma once

#include <functional>
#include <string>
#include <vector>

#include "samara/core/surface/surface.hpp"

namespace samara {

/// A session of gmsh, with its default options and an empty model: started by the constructor and ended by
/// the destructor. gmsh has global state, so only one session may exist at a time. OpenCASCADE and scripts
/// write to standard output.
class GmshSession {
  public:
    GmshSession();
    ~GmshSession();
    GmshSession(const GmshSession&) = delete;
    GmshSession& operator=(const GmshSession&) = delete;

    /// Runs calls of gmsh. What gmsh throws becomes an Error "LABEL: WHAT: <gmsh's own reason>"; an Error of
    /// `calls` itself passes on.
    static void run(const std::string& label, const std::string& what, const std::function<void()>& calls);

    /// Opens a script or a mesh: gmsh takes for a script what does not begin as a mesh, whatever its name.
    /// Solids of OpenCASCADE that overlap or touch are cut as by import_shapes. Throws Error "LABEL: gmsh
    /// cannot read it: <reason>" at gmsh's first error.
    static void open(const std::string& label);

    /// Reads exact geometry of the format "step" or "brep", and never a script. Solids that overlap or touch
    /// are cut into pieces that share their walls. The model is scaled to suit the absolute tolerances of
    /// gmsh and OpenCASCADE: returns its size relative to that in the file's unit (metres for STEP). Throws
    /// as open does.
    static double import_shapes(const std::string& label, const std::string& format);

    /// Has gmsh mesh the surfaces of the model again. Where it fails, the mesh may be open and must be
    /// checked.
    static void generate_surface_mesh();

  private:
    static void load(const std::string& label, const std::function<void()>& calls);
};

/// Returns gmsh's version, such as "4.8.4".
std::string gmsh_version();

/// Returns the surface elements of the model in the current GmshSession: those of the surfaces with the given
/// tags, or of all where none are given. Quadrangles are cut in two. Throws Error, which names `label`, for
/// other elements than triangles of order 1 or 2 and quadrangles of order 1.
Surface surface_of_model(const std::string& label, const std::vector<int>& surface_tags = {});

/// Returns surface_of_model() of a mesh of order 1 with a node added to each edge: the point of the geometry,
/// curve or surface, that is nearest to the middle of the straight edge. Faster than gmsh's own, which takes
/// 10 s for 1280 triangles on a NURBS ellipsoid.
Surface curved_surface_of_model(const std::string& label, const std::vector<int>& surface_tags);

}  // namespace samara
