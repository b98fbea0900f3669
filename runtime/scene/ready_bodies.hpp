#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace samara {

/// Prefix of a scene's `shape` that names a ready-baked body: "samara:leaf".
inline constexpr std::string_view ready_body_prefix = "samara:";

/// One ready-baked body, by the index of its folder, bodies.toml. Members that the index does not give are
/// empty.
struct ReadyBody {
    std::string name;               ///< the body file is NAME.body.h5 in the same folder
    std::filesystem::path file;     ///< the body file, which may not exist: see exists
    bool exists = false;            ///< whether it has been baked
    std::string fluid;              ///< "water" or "air": the fluid of its bake
    std::optional<double> density;  ///< kg/m^3, of the body: gives its Reynolds numbers
    std::string purpose;            ///< a few words on its use
};

/// Returns the folder of the ready-baked bodies (find_share_folder): in SAMARA_BODIES, share/samara/bodies or
/// this source tree. Throws Error where none of them is a folder.
std::filesystem::path ready_bodies_folder();

/// Returns the bodies of a folder by name: its body files, and those that its index lists and that are not
/// baked. Throws Error where the index cannot be understood.
std::vector<ReadyBody> ready_bodies(const std::filesystem::path& folder);

/// Returns the body file of a ready-baked body. Throws Error, which names those that exist, where there is
/// none of that name.
std::filesystem::path ready_body_file(const std::string& name);

}  // namespace samara
