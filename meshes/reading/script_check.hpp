#pragma once

#include <string>
#include <string_view>

namespace samara {

/// Throws Error, "LABEL: line N: ...", at the first statement of a gmsh script (.geo) that a shape does not
/// need: one that starts programs (SystemCall, NonBlockingSystemCall, System, OnelabRun, fields of the type
/// ExternalProcess), writes files or makes folders (Save, Print, Printf > and >>, CreateDir), sends data
/// (SendToServer) or ends gmsh (Exit). The check is for a clear message: what it overlooks, for example in
/// included files, the process that reads the script is not permitted to do (confined_surface).
void require_shape_script(std::string_view script, const std::string& label);

}  // namespace samara
