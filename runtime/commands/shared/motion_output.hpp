#pragma once

#include <string>

namespace samara {

/// Throws Error unless the name is one that a motion file may have, NAME.h5: for a name in another program's
/// format it says which command makes such a file from a motion file.
void require_motion_file_name(const std::string& output);

}  // namespace samara
