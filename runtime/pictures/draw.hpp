#pragma once

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

namespace samara {

/// Draws a picture by Python's matplotlib: .svg where the file's name ends so, else PNG of 2000 x 1300
/// pixels. `picture`: as samara.plot.draw() of the Python package takes it; its "picture" names what it
/// shows. Returns what the picture shows beyond what it was given, such as {"silhouettes": 12}. The file
/// stands whole, or not at all. Throws Error where Python, a module or the file cannot be had.
nlohmann::json draw_picture(const std::filesystem::path& file, nlohmann::json picture);

/// Writes a report as one HTML page in the same manner: `page` as samara.report.page() takes it.
void draw_page(const std::filesystem::path& file, nlohmann::json page);

/// Throws Error where the picture's name ends neither in .png nor in .svg.
void require_picture_format(const std::filesystem::path& file);

}  // namespace samara
