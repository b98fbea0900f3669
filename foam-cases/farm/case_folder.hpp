#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "converter/falls/free_fall.hpp"
#include "foam-cases/bake/bake_plan.hpp"

namespace samara {

/// The name of the body file in a folder of cases.
inline constexpr const char* case_body_name = "body.body.h5";

/// Returns the folder of the case templates and the farm's scripts (find_share_folder): SAMARA_FOAM_CASES,
/// share/samara/foam-cases or this source tree. Throws Error where none of them holds a Snakefile.
std::filesystem::path foam_cases_folder();

/// Throws Error where the folder holds cases of the other type, which would be removed: outputs with the same
/// stem share their folder.
void require_cases_of(CaseType type, const std::filesystem::path& folder);

/// Whether cases in a folder that are not in the plan are removed or kept: a bake in rounds may plan them
/// later.
enum class Unplanned { removed, kept };

/// Writes the folder of cases (docs/file-formats): body.body.h5, plan.json, one OpenFOAM case for each mesh,
/// and one, linked to its mesh, for each case and fall of the plan. Existing files are checked first
/// (require_known_files); inputs whose content differs are rewritten, others are left unchanged. Meshes and
/// cases that were made from other inputs lose their mesh.json, provenance.json and failed.json, so that they
/// will be made again; folders of cases that are no longer planned are removed, unless they are to be kept.
/// Throws Error where the folder holds what is neither an input nor a result, where it cannot be written, and
/// where a template lacks a parameter.
void write_case_folder(const std::filesystem::path& folder, const Body& body, const BakePlan& plan,
                       const std::filesystem::path& foam_cases, Unplanned unplanned = Unplanned::removed);

/// Returns the names of the meshes that are made and of the cases and falls that are solved in a folder of
/// cases, by the inputs of the plan: write_case_folder() keeps them. Only reads.
std::set<std::string> made_folders(const std::filesystem::path& folder, const Body& body,
                                   const BakePlan& plan, const std::filesystem::path& foam_cases);

/// Returns the body's surface in case axes as an ASCII STL file of one solid, "body". Triangles of order 2
/// become four flat ones, so that the mesh follows the curved surface's edge nodes.
std::string case_surface_stl(const Body& body, const BakePlan& plan);

/// The files of a case: contents by their path in the case.
using CaseFiles = std::map<std::filesystem::path, std::string>;

/// The type of a folder in the folder of cases.
enum class FolderType { mesh, flow, fall };

/// The planned folder of a mesh, a case or a fall.
struct InputFolder {
    FolderType type;
    CaseFiles files;   ///< inputs
    std::string mesh;  ///< name of the mesh that it is linked to; empty for a mesh
    std::string hash;  ///< hash of all inputs of its solution
};

/// The folders of a plan, by their names.
using InputFolders = std::map<std::string, InputFolder>;

/// Checks that a folder of cases, which may be of another origin, is safe to use, since OpenFOAM and Python
/// read more files than they are given. Besides the inputs, which are rewritten, it may contain only files
/// that solving leaves behind: with known names, no links except those to a mesh, no pipes and no devices,
/// and fields, meshes and states that hold nothing but data (require_foam_data). Throws Error naming the
/// first other file, and the remedy. Only reads, and follows no link. A folder that does not exist passes.
void require_known_files(const std::filesystem::path& cases, const InputFolders& planned);

/// Returns the file `parameters` of one case: the template's text with the case's values; comments and
/// further entries stay. Throws Error where the template lacks an entry.
std::string case_parameters(const std::string& template_text, const BakePlan& plan, const BakeCase& entry);

/// Returns the file system/decomposeParDict of a case that so many MPI processes share, by a template as in
/// case_parameters().
std::string decomposition(const std::string& template_text, int ranks);

/// Returns the file `parameters` of a fall's case, by a template as in case_parameters().
std::string fall_parameters(const std::string& template_text, const BakePlan& plan, const FreeFall& fall);

/// Return the file `parameters` of a case that only makes a mesh, and its entries on which the mesh depends.
std::string mesh_case_parameters(const std::string& template_text, const FlowMesh& mesh);
std::string mesh_parameters_of(const std::string& parameters);

}  // namespace samara
