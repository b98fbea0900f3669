#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace samara {

/// What a scene's `shape` begins with where it names a ready-baked body: "samara:leaf".
inline constexpr std::string_view ready_body_prefix = "samara:";

/// One ready-baked body, by the index of its folder, bodies.toml. What the index does not say is empty.
struct ReadyBody {
    std::string name;               ///< the body file is NAME.body.h5 in the same folder
    std::filesystem::path file;     ///< that file, which may not be there: see exists
    bool exists = false;            ///< whether it has been baked
    std::string fluid;              ///< "water" or "air": what it was baked to fall in
    std::optional<double> density;  ///< kg/m^3: of the body, from which its Reynolds numbers follow
    std::string purpose;            ///< what it is for, a few words
};

/// Where the ready-baked bodies are (find_share_folder): in SAMARA_BODIES, share/samara/bodies or this source
/// tree. Throws Error where none of them is a folder.
std::filesystem::path ready_bodies_folder();

/// The bodies of a folder by name: its body files, and what its index lists but is not baked. Throws Error
/// where the index cannot be understood.
std::vector<ReadyBody> ready_bodies(const std::filesystem::path& folder);

/// The body file of a ready-baked body. Throws Error, which names those there are, where there is none of
/// that name.
std::filesystem::path ready_body_file(const std::string& name);

}  // namespace samara
