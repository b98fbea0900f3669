#pragma once

#include <functional>
#include <string>

namespace samara {

/// gmsh, started when this is made and ended with it: with its default options and an empty model. gmsh is
/// one for the process, so only one session may live at a time. OpenCASCADE and scripts write on standard
/// output.
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
    /// are cut into pieces that share their walls. The model is made as large as suits the tolerances of gmsh
    /// and OpenCASCADE, which are lengths: returns its size over that in the file's unit, metres for STEP.
    /// Throws as open does.
    static double import_shapes(const std::string& label, const std::string& format);

    /// Has gmsh mesh the surfaces of the model anew. It may leave the mesh open where it fails: check it.
    static void generate_surface_mesh();

  private:
    static void load(const std::string& label, const std::function<void()>& calls);
};

/// gmsh's version, "4.8.4".
std::string gmsh_version();

}  // namespace samara
