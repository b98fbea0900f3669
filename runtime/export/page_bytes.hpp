#pragma once

#include <string_view>

namespace samara {

/// The player's page with the mark <!--MOTION--> in it; empty where it was not built in.
std::string_view page_bytes();

}  // namespace samara
