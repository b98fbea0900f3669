#pragma once

#include <filesystem>
#include <string>

namespace samara {

/// Draws a picture of canvas::width x canvas::height pixels with gnuplot: .svg where the file's name ends so,
/// else PNG. `commands`: data blocks and plots within a multiplot; encoding, terminal, borders and grid are
/// set. Throws Error where gnuplot is not installed or fails, and where the file cannot be written.
void draw_picture(const std::filesystem::path& file, const std::string& commands);

/// Throws Error where the picture's name ends neither in .png nor in .svg.
void require_picture_format(const std::filesystem::path& file);

}  // namespace samara
