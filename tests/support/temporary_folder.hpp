#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

#include "samara/core/files/folders.hpp"

namespace samara::test {

/// An empty folder for one test, removed at its end.
class TemporaryFolder : public samara::TemporaryFolder {
  public:
    TemporaryFolder() {}  // NOLINT(modernize-use-equals-default): a const one needs a constructor of its own

    /// Writes a file in the folder, makes its parent folders, and returns its path.
    [[nodiscard]] std::filesystem::path file(const std::filesystem::path& name, std::string_view text) const {
        const std::filesystem::path target = path() / name;
        std::filesystem::create_directories(target.parent_path());
        std::ofstream(target, std::ios::binary) << text;
        return target;
    }
    /// Returns the number of files and folders in it.
    [[nodiscard]] std::ptrdiff_t file_count() const {
        return std::distance(std::filesystem::directory_iterator(path()), {});
    }
};

}  // namespace samara::test
