#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "converter/cases/mesh_section.hpp"

namespace samara {

/// A mesh to be drawn.
struct DrawnMesh {
    std::string title;    ///< with its cells
    MeshSection section;  ///< lengths over L
    double half_width;    ///< of what is shown
    double half_height;   ///< likewise
};

/// The places (pixels) of one to four panels that show meshes; wide over high gives the section's shape.
std::vector<double> mesh_panel_shape(std::size_t count);

/// Draws one to four meshes where a plane cuts them. Throws Error as draw_picture does.
void plot_meshes(const std::filesystem::path& file, const std::string& name, const std::string& plane,
                 const std::vector<DrawnMesh>& meshes);

/// What a case did while it was solved, at its iterations; a value that is not finite is left out.
struct CaseHistory {
    std::string name;
    std::vector<double> iterations;
    std::vector<double> drag;  ///< coefficients on A = pi L^2/4
    std::vector<double> moment;
    std::vector<double> k;  ///< k/U^2 of the shell; empty where the flow is laminar
    std::vector<double> residual_iterations;
    std::vector<double> residuals;  ///< initial, of the pressure, in the last round
};

/// Draws the histories of cases over each other. Throws Error as draw_picture does.
void plot_histories(const std::filesystem::path& file, const std::string& name,
                    const std::vector<CaseHistory>& cases);

}  // namespace samara
