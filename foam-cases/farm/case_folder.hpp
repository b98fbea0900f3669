#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "converter/falls/free_fall.hpp"
#include "foam-cases/bake/bake_plan.hpp"

namespace samara {

/// The body file in a folder of cases: the body that they are around.
inline constexpr const char* case_body_name = "body.body.h5";

/// Where the case templates and the farm's scripts are (find_share_folder): in SAMARA_FOAM_CASES,
/// share/samara/foam-cases or this source tree. Throws Error where none of them holds a Snakefile.
std::filesystem::path foam_cases_folder();

/// Throws Error where the folder holds cases of the other kind, which would be removed: outputs of the same
/// stem share their folder.
void require_cases_of(CaseType type, const std::filesystem::path& folder);

/// What becomes of cases in a folder that the plan has not: a bake that goes in rounds may plan them yet.
enum class Unplanned { removed, kept };

/// Writes the folder of cases (docs/file-formats): body.body.h5, plan.json, one OpenFOAM case for each mesh,
/// and one, linked to its mesh, for each case and fall of the plan. What stands there already is looked
/// through first (require_known_files); an input of another content is written anew, one whose content is
/// there already is left alone. Meshes and cases that were made on other inputs lose their mesh.json,
/// provenance.json and failed.json, so that they will be made again; folders of cases that are no longer
/// planned are removed, unless they are to be kept. Throws Error where the folder holds what is neither an
/// input nor a result, where it cannot be written, and where a template lacks a parameter.
void write_case_folder(const std::filesystem::path& folder, const Body& body, const BakePlan& plan,
                       const std::filesystem::path& foam_cases, Unplanned unplanned = Unplanned::removed);

/// The body's surface in case axes as an ASCII STL file of one solid, "body". Triangles of order 2 become
/// four flat ones, so that the mesh sees the curved surface's edge nodes.
std::string case_surface_stl(const Body& body, const BakePlan& plan);

/// Contents by the path inside a case.
using CaseFiles = std::map<std::filesystem::path, std::string>;

/// What stands in a folder of its own beside the others.
enum class FolderType { mesh, flow, fall };

/// The folder of a mesh, a case or a fall, as it is to be.
struct InputFolder {
    FolderType type;
    CaseFiles files;   ///< its inputs
    std::string mesh;  ///< whose folder it is linked to; of a mesh itself none
    std::string hash;  ///< of all that its solution depends on
};

/// The folders of a plan, by their names.
using InputFolders = std::map<std::string, InputFolder>;

/// Holds a folder of cases, which may be of other hands, against what is planned in it: OpenFOAM and Python
/// read more than what they are given. Besides the inputs, which are written anew, only what solving leaves
/// behind may stand there: known names; no link but those to a mesh; no pipe and no device; in fields, meshes
/// and states nothing but data (require_foam_data). Throws Error naming the first file that is anything else,
/// and how to go on without it. Reads only, and follows no link. A folder that does not exist is as it should
/// be.
void require_known_files(const std::filesystem::path& cases, const InputFolders& planned);

/// The file `parameters` of one case: the template's text with the case's values in place of the template's;
/// comments and further entries stay. Throws Error where the template lacks an entry.
std::string case_parameters(const std::string& template_text, const BakePlan& plan, const BakeCase& entry);

/// The same of a fall's case.
std::string fall_parameters(const std::string& template_text, const BakePlan& plan, const FreeFall& fall);

/// The file `parameters` of a case that only makes a mesh, and its entries that the mesh depends on.
std::string mesh_case_parameters(const std::string& template_text, const FlowMesh& mesh);
std::string mesh_parameters_of(const std::string& parameters);

}  // namespace samara
