#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace samara {

/// The fluid at distances from 0.05 L to 0.25 L of the body: the cell zone `shell` of a mesh.
struct Shell {
    std::filesystem::path poly_mesh;
    std::vector<std::int64_t> cells;
    std::vector<double> volumes;  ///< of the cells; computed by Shells::volumes
};

/// The shells of the meshes of one folder of cases, each read once.
class Shells {
  public:
    /// Returns the shell of FOLDER/constant/polyMesh. Throws Error where it has no such zone.
    Shell& of(const std::filesystem::path& folder);
    /// Returns the volumes of a shell's cells, from the mesh (cell_volumes).
    static const std::vector<double>& volumes(Shell& shell);
    /// Returns area_of_patches() of FOLDER/constant/polyMesh.
    std::optional<double> area(const std::filesystem::path& folder, const std::vector<std::string>& patches);

  private:
    using Patches = std::pair<std::filesystem::path, std::vector<std::string>>;

    std::map<std::filesystem::path, Shell> shells_;
    std::map<Patches, std::optional<double>> areas_;
};

/// Returns the last time whose fields the case wrote, reconstructed or by processor; 0 where there is only
/// the start.
double last_written_time(const std::filesystem::path& folder);

/// Volume means over the shell of the fields that a case wrote last.
struct ShellMeans {
    std::filesystem::path folder;  ///< of the last time
    double time;
    double turbulent_kinetic_energy;
    double dissipation_rate;
};

/// Averages the fields k and epsilon of the last written time over the shell, weighted by the field V or,
/// where there is none, by the mesh's volumes. `mesh`: the folder whose constant/polyMesh the case was solved
/// on. Where the case is decomposed and not reconstructed, sums over processor0, processor1, ... and their
/// meshes. Throws Error where there is no written time but 0, where a processor's folder or a file is missing
/// or damaged, where field and shell do not belong together, and where the case is decomposed in the collated
/// layout (the message says how to reconstruct it).
ShellMeans mean_over_shell(const std::filesystem::path& folder, const std::filesystem::path& mesh,
                           Shells& shells);

}  // namespace samara
