#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace samara {

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

}  // namespace samara
