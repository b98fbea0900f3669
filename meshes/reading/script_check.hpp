#pragma once

#include <string>
#include <string_view>

namespace samara {

/// Throws Error, "LABEL: line N: ...", at the first statement of a gmsh script (.geo) that a shape has no use
/// for: those that start programs (SystemCall, NonBlockingSystemCall, System, OnelabRun, fields of the kind
/// ExternalProcess), write files or make folders (Save, Print, Printf > and >>, CreateDir), talk to others
/// (SendToServer) or end gmsh (Exit). It is there for the clear line: what it overlooks, as in
/// files that the script includes, the process that reads the script has no right to do (confined_surface).
void require_shape_script(std::string_view script, const std::string& label);

}  // namespace samara
