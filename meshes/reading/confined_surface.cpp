#include "meshes/reading/confined_surface.hpp"

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/files/confined_process.hpp"
#include "samara/core/surface/welded_surface.hpp"

namespace samara {
namespace {

// A message is a share of the work or, of the last ones, a surface: the lists one after the other, each
// with its length.
constexpr char share_tag = 'p';
constexpr char surface_tag = 's';

static_assert(std::is_trivially_copyable_v<std::array<std::int32_t, 3>>);
static_assert(sizeof(Vector3d) == 3 * sizeof(double));

template <typename Item>
void append(std::string& bytes, const std::vector<Item>& list) {
    const std::uint64_t size = list.size() * sizeof(Item);
    bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
    bytes.append(reinterpret_cast<const char*>(list.data()), size);
}

// Whether the bytes began with a whole list.
template <typename Item>
bool take(std::string_view& bytes, std::vector<Item>& list) {
    std::uint64_t size = 0;
    if (bytes.size() < sizeof size) return false;
    std::memcpy(&size, bytes.data(), sizeof size);
    bytes.remove_prefix(sizeof size);
    if (size > bytes.size() || size % sizeof(Item) != 0) return false;
    list.resize(size / sizeof(Item));
    if (size > 0) std::memcpy(static_cast<void*>(list.data()), bytes.data(), size);
    bytes.remove_prefix(size);
    return true;
}

Surface unpacked(std::string_view bytes, const std::string& label) {
    Surface surface;
    const bool whole = take(bytes, surface.vertices) && take(bytes, surface.corners) &&
                       take(bytes, surface.edge_nodes) && bytes.empty();
    if (!whole || (surface.order() == 2 && surface.edge_nodes.size() != surface.corners.size())) {
        throw Error(fmt::format("{}: its surface came damaged from the process that reads it", label));
    }
    labelled(label, [&] { require_usable_numbers(surface); });
    return surface;
}

}  // namespace

std::vector<Surface> confined_surfaces(
    const std::filesystem::path& shape, std::size_t count, double time_limit,
    const std::function<std::vector<Surface>(const std::function<void(double)>& progress)>& read,
    const std::function<void(double)>& progress) {
    ConfinedLimits limits;
    limits.cpu_seconds = time_limit;
    // Of the name and, where that is a link, of the file.
    for (const std::filesystem::path& file :
         {std::filesystem::absolute(shape), std::filesystem::canonical(shape)}) {
        limits.readable.push_back(file.parent_path());
    }
    std::vector<Surface> surfaces;
    run_confined(
        shape.string(), limits,
        [&](const SendBytes& send) {
            const std::vector<Surface> results = read([&](double share) {
                std::string bytes(1, share_tag);
                send(bytes.append(reinterpret_cast<const char*>(&share), sizeof share));
            });
            for (const Surface& result : results) {
                std::string bytes(1, surface_tag);
                append(bytes, result.vertices);
                append(bytes, result.corners);
                append(bytes, result.edge_nodes);
                send(bytes);
            }
        },
        [&](std::string_view bytes) {
            double share = 0.0;
            if (bytes.starts_with(surface_tag) && surfaces.size() < count) {
                surfaces.push_back(unpacked(bytes.substr(1), shape.string()));
            } else if (progress && bytes.size() == 1 + sizeof share) {
                std::memcpy(&share, bytes.data() + 1, sizeof share);
                progress(share);
            }
        });
    if (surfaces.size() != count) {
        throw Error(
            fmt::format("{}: its surface came damaged from the process that reads it", shape.string()));
    }
    return surfaces;
}

Surface confined_surface(const std::filesystem::path& shape, double time_limit,
                         const std::function<Surface(const std::function<void(double)>& progress)>& read,
                         const std::function<void(double)>& progress) {
    return confined_surfaces(
               shape, 1, time_limit,
               [&](const std::function<void(double)>& tell) { return std::vector<Surface>{read(tell)}; },
               progress)
        .front();
}

}  // namespace samara
