#pragma once

#include <filesystem>
#include <string>

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

}  // namespace samara
