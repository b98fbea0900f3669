#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace samara {

/// A folder that OpenFOAM named by a time: "0", "100", "0.25", "1e-05".
struct TimeFolder {
    double time;
    std::filesystem::path path;
};

/// The time by which a folder is named; nothing where its name is no number.
std::optional<double> time_of(const std::filesystem::path& folder);

/// The time folders in a folder, by ascending time; empty where the folder does not exist.
std::vector<TimeFolder> time_folders(const std::filesystem::path& folder);

}  // namespace samara
