#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "converter/openfoam/foam_history.hpp"
#include "samara/core/body/load_tables.hpp"

namespace samara {

/// The history of a case's means of k and epsilon, by its function object `nearWake` or, of earlier
/// cases, `shell`; the cell zone has the function object's name.
struct TurbulenceHistory {
    TurbulenceMean mean;
    std::string zone;               ///< also the folder in postProcessing
    std::string dissipation_field;  ///< epsilon, or turbulenceProperties:epsilon of a closure with omega
    FoamHistory means;
    std::size_t k_column;
    std::size_t epsilon_column;
};

/// Reads the history in CASE/postProcessing. Throws Error where there is none or a column is missing.
TurbulenceHistory read_turbulence_history(const std::filesystem::path& case_folder);

/// The cells near the body over which k and epsilon are averaged.
struct MeshZone {
    std::filesystem::path poly_mesh;
    std::vector<std::int64_t> cells;
    std::vector<double> volumes;  ///< of the cells; computed by MeshZones::volumes
};

/// The zones of the meshes of one folder of cases, each read once.
class MeshZones {
  public:
    /// Returns the zone of that name of FOLDER/constant/polyMesh. Throws Error where there is none.
    MeshZone& of(const std::filesystem::path& folder, const std::string& name);
    /// Returns the volumes of a zone's cells, from the mesh (cell_volumes).
    static const std::vector<double>& volumes(MeshZone& zone);
    /// Returns area_of_patches() of FOLDER/constant/polyMesh.
    std::optional<double> area(const std::filesystem::path& folder, const std::vector<std::string>& patches);

  private:
    using Zone = std::pair<std::filesystem::path, std::string>;
    using Patches = std::pair<std::filesystem::path, std::vector<std::string>>;

    std::map<Zone, MeshZone> zones_;
    std::map<Patches, std::optional<double>> areas_;
};

/// Returns the last time whose fields the case wrote, reconstructed or by processor; 0 where there is only
/// the start.
double last_written_time(const std::filesystem::path& folder);

/// Means of k and epsilon of the fields that a case wrote last.
struct WrittenMeans {
    std::filesystem::path folder;  ///< of the last time
    double time;
    double turbulent_kinetic_energy;
    double dissipation_rate;
};

/// Averages the fields k and epsilon of the last written time as `history` does, with the field V or, where
/// there is none, the mesh's volumes. `mesh`: the folder whose constant/polyMesh the case was solved
/// on. Where the case is decomposed and not reconstructed, sums over processor0, processor1, ... and their
/// meshes. Throws Error where there is no written time but 0, where a processor's folder or a file is missing
/// or damaged, where field and zone do not belong together, and where the case is decomposed in the collated
/// layout (the message says how to reconstruct it).
WrittenMeans written_means(const std::filesystem::path& folder, const std::filesystem::path& mesh,
                           const TurbulenceHistory& history, MeshZones& zones);

}  // namespace samara
