// Shapes that samara reads by itself: STL in text and binary ('s'), OBJ ('o'), and the check of gmsh scripts
// ('g'). The first letter of the input says which, the rest is the file.

#include <cmath>
#include <filesystem>
#include <fstream>

#include "harness.hpp"
#include "meshes/checks/shape_error.hpp"
#include "meshes/checks/sound_surface.hpp"
#include "meshes/reading/shape_reader.hpp"
#include "samara/core/files/folders.hpp"
#include "samara/core/surface/mended_surface.hpp"
#include "samara/core/surface/obj_file.hpp"
#include "samara/core/surface/stl_file.hpp"

namespace samara::fuzz {

void feed(std::string_view input) {
    static const TemporaryFolder folder;
    if (input.empty()) return;
    const std::string_view bytes = input.substr(1);
    if (input.front() == 'g') {
        accepted([&] { require_shape_script(bytes, "shape"); });
        return;
    }
    const std::filesystem::path file = folder / "shape";
    std::ofstream(file, std::ios::binary) << bytes;
    const auto read = input.front() == 'o' ? read_obj_file : read_stl_file;
    const auto surface = accepted([&] { return read(file); });
    if (!surface) return;
    const auto whole = accepted([&] { return mended(*surface); });
    if (!whole || !accepted([&] { require_sound_surface(*whole); })) return;
    const VolumeMoments moments = volume_moments(*whole);
    require(moments.volume > 0.0 && std::isfinite(moments.volume), "a sound surface has a volume");
    require(moments.centroid.allFinite() && moments.second_moments.allFinite(), "moments are finite");
}

}  // namespace samara::fuzz
