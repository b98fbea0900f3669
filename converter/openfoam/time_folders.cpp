#include "converter/openfoam/time_folders.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

namespace samara {

std::optional<double> time_of(const std::filesystem::path& folder) {
    const std::string name = folder.filename().string();
    double time = 0.0;
    const auto [end, status] = std::from_chars(name.data(), name.data() + name.size(), time);
    const bool is_number = status == std::errc() && end == name.data() + name.size() && std::isfinite(time);
    return is_number ? std::optional(time) : std::nullopt;
}

std::vector<TimeFolder> time_folders(const std::filesystem::path& folder) {
    std::vector<TimeFolder> folders;
    if (!std::filesystem::is_directory(folder)) return folders;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::optional<double> time = time_of(entry.path());
        if (time && entry.is_directory()) folders.push_back({*time, entry.path()});
    }
    std::sort(folders.begin(), folders.end(),
              [](const TimeFolder& a, const TimeFolder& b) { return a.time < b.time; });
    return folders;
}

}  // namespace samara
