#include "converter/time_folders.hpp"

#include <algorithm>
#include <charconv>
#include <string>

namespace samara {

std::vector<TimeFolder> time_folders(const std::filesystem::path& folder) {
    std::vector<TimeFolder> folders;
    if (!std::filesystem::is_directory(folder)) return folders;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        double time = 0.0;
        const auto [end, status] = std::from_chars(name.data(), name.data() + name.size(), time);
        const bool number = status == std::errc() && end == name.data() + name.size();
        if (number && entry.is_directory()) folders.push_back({time, entry.path()});
    }
    std::sort(folders.begin(), folders.end(),
              [](const TimeFolder& a, const TimeFolder& b) { return a.time < b.time; });
    return folders;
}

}  // namespace samara
