#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

class FoamScanner;

/// The entries "name value;" of an OpenFOAM dictionary, as text, and the dictionaries within it. Directives
/// are passed over; what "#include" names is kept.
class FoamDictionary {
  public:
    /// Reads the file, with or without a FoamFile header. Throws Error with file and line.
    explicit FoamDictionary(const std::filesystem::path& file);

    /// The file that the dictionary was read from.
    [[nodiscard]] const std::filesystem::path& file() const { return path_; }
    [[nodiscard]] bool has(const std::string& name) const { return entries_.contains(name); }
    /// Returns the entry's text. Throws Error where there is none.
    [[nodiscard]] const std::string& text(const std::string& name) const;
    /// Returns the entry as a number. Throws Error where it is none.
    [[nodiscard]] double number(const std::string& name) const;
    /// Returns the entry "(x y z)". Throws Error where it is not three numbers.
    [[nodiscard]] Vector3d vector(const std::string& name) const;
    /// The nested dictionaries, by their names.
    [[nodiscard]] const std::map<std::string, FoamDictionary>& dictionaries() const { return dictionaries_; }
    /// The names of the files that the dictionary includes.
    [[nodiscard]] const std::vector<std::string>& included() const { return included_; }

  private:
    FoamDictionary(std::filesystem::path path, FoamScanner& scanner, int depth);
    /// Reads up to the end of the file or nested dictionary.
    void read(FoamScanner& scanner, int depth);
    [[nodiscard]] std::string place_of(const std::string& name) const;

    std::filesystem::path path_;
    std::map<std::string, std::string> entries_;
    std::map<std::string, FoamDictionary> dictionaries_;
    std::vector<std::string> included_;
};

/// Returns the three numbers of "(x y z)"; nothing for other texts.
std::optional<Vector3d> foam_vector(std::string_view text);

}  // namespace samara
