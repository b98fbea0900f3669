#pragma once

#include <functional>

namespace samara {

/// Called now and then with the work done and the whole work, in rows or files.
using ExportProgress = std::function<void(double done, double total)>;

}  // namespace samara
