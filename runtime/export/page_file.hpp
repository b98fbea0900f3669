#pragma once

#include <filesystem>
#include <string>

#include "samara/export/copy_style.hpp"
#include "samara/motion/motion.hpp"

namespace samara {

/// Returns whether this library was built with the page (SAMARA_PAGE) that write_page needs.
bool has_page();

/// Writes one run of a motion as a page (.html) that plays it in a browser without a network: the bodies with
/// all copies in space, and the time series of descent speed, inclination and angular speed under it. The
/// page is one file: three.js, the player (runtime/page) and the motion.
///
/// The motion is in it as floats: at every frame the place of the centre of mass, the orientation and the
/// three measures, 40 bytes, 53 in base64. A body is shown by its display mesh with materials and images,
/// where it has one. `title` and `detail` head the page. Equal motions give equal bytes. Throws Error where
/// the library was built without the page, where the poses exceed 384 MB, which is what browsers read in one
/// piece, and where the file cannot be written. `run` must be in the motion.
void write_page(const std::filesystem::path& file, const Motion& motion, int run, const std::string& title,
                const std::string& detail, const CopyStyle& style = {});

}  // namespace samara
