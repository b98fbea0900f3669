#pragma once

#include <filesystem>
#include <vector>

namespace samara {

/// A folder that OpenFOAM named by a time: "0", "100", "0.25", "1e-05".
struct TimeFolder {
    double time;
    std::filesystem::path path;
};

/// The time folders in a folder, by ascending time; empty where the folder does not exist.
std::vector<TimeFolder> time_folders(const std::filesystem::path& folder);

}  // namespace samara
