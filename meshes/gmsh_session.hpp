#pragma once

#include <functional>
#include <string>

namespace samara {

/// gmsh, started when this is made and ended with it: silent, with its default options and an empty model.
/// gmsh is one for the process, so only one session may live at a time.
class GmshSession {
  public:
    GmshSession();
    ~GmshSession();
    GmshSession(const GmshSession&) = delete;
    GmshSession& operator=(const GmshSession&) = delete;

    /// Runs calls of gmsh. What gmsh throws becomes an Error "LABEL: WHAT: <gmsh's own reason>"; an Error of
    /// `calls` itself passes on.
    static void run(const std::string& label, const std::string& what, const std::function<void()>& calls);

    /// Opens a file that gmsh reads. Throws Error "LABEL: gmsh cannot read it: <reason>" at gmsh's first
    /// error.
    static void open(const std::string& label);

    /// Has gmsh mesh the surfaces of the model anew. It may leave the mesh open where it fails: check it.
    static void generate_surface_mesh();

  private:
    int standard_output_;  // a copy of the descriptor that gmsh may not write on
};

/// gmsh's version, "4.8.4".
std::string gmsh_version();

}  // namespace samara
