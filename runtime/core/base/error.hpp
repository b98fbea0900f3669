#pragma once

#include <stdexcept>
#include <string>

namespace samara {

/// The one exception of the offline tools. Its text is one line for the user: it names the file, the place
/// and the remedy. Programs print it after their name and exit with status 1. The runtime's step never
/// throws.
class Error : public std::runtime_error {
  public:
    /// An error of that text.
    explicit Error(const std::string& message) : std::runtime_error(message) {}
};

}  // namespace samara
