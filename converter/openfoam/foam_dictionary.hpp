#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "samara/base/linear_algebra.hpp"

namespace samara {

/// The plain entries "name value;" of an OpenFOAM dictionary, as text. Dictionaries within it and directives
/// (#include) are passed over.
class FoamDictionary {
  public:
    /// Reads the file, with or without a FoamFile header. Throws Error with file and line.
    explicit FoamDictionary(const std::filesystem::path& file);

    [[nodiscard]] bool has(const std::string& name) const { return entries_.contains(name); }
    /// The entry's text. Throws Error where there is none.
    [[nodiscard]] const std::string& text(const std::string& name) const;
    /// The entry as a number. Throws Error where it is none.
    [[nodiscard]] double number(const std::string& name) const;
    /// The entry "(x y z)". Throws Error where it is not three numbers.
    [[nodiscard]] Vector3d vector(const std::string& name) const;

  private:
    [[nodiscard]] std::string place_of(const std::string& name) const;

    std::filesystem::path path_;
    std::map<std::string, std::string> entries_;
};

}  // namespace samara
