#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace samara::test {

/// Installs the add-on in a Blender with folders of its own, does a task of tests/tools/use_addon.py and
/// returns what it found. A Blender that fails, or shows an exception's trace, fails the test.
nlohmann::json use_addon(const std::vector<std::string>& task);

/// Does a task of tests/tools/use_addon.py as use_addon() does, with a window on a screen in memory alone:
/// buttons run beside it, and keys reach them.
nlohmann::json use_addon_in_window(const std::vector<std::string>& task);

}  // namespace samara::test
