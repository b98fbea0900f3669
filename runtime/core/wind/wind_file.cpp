#include "samara/core/wind/wind_file.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/version.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/hdf5_writer.hpp"

namespace samara {
namespace {

constexpr std::int64_t format_version = 1;
constexpr const char* dataset = "/wind/velocity";
constexpr double largest = 1e30;
constexpr std::size_t most_bytes = std::size_t{64} << 30U;

Error error(const std::filesystem::path& file, const std::string& what) {
    return Error(fmt::format("{}: {}; make it again with 'samara wind'", file.string(), what));
}

Vector3d vector_in(const Hdf5Reader& file, const std::string& name) {
    return Vector3d(file.finite_doubles(name, {3}).data());
}

}  // namespace

WindGrid read_wind_file(const std::filesystem::path& path) {
    const Hdf5Reader file(path);
    if (!file.has(dataset))
        throw Error(fmt::format("{}: is not a wind file: it has no {}", path.string(), dataset));
    if (file.integer_attribute("/", "format_version") > format_version) {
        throw error(path, "was written by a newer version of samara");
    }
    const std::vector<hsize_t> shape = file.shape(dataset);
    if (shape.size() != 5 || shape[4] != 3 || std::find(shape.begin(), shape.end(), 0U) != shape.end()) {
        throw error(path, fmt::format("{} does not have the shape (times, z, y, x, 3)", dataset));
    }
    WindGrid grid;
    grid.frames = shape[0];
    grid.nodes = {shape[3], shape[2], shape[1]};
    grid.origin = vector_in(file, "/wind/origin");
    grid.spacing = vector_in(file, "/wind/spacing");
    grid.interval = file.number_attribute("/wind", "interval");
    grid.source = file.text_attribute("/wind", "source");
    if (!(grid.spacing.minCoeff() > 0.0))
        throw error(path, "/wind/spacing has a value that is not above zero");
    if (!(grid.interval > 0.0 && grid.interval < largest))
        throw error(path, "/wind has an interval that is not above zero");
    grid.velocities.reserve(grid.size());
    for (hsize_t frame = 0; frame < shape[0]; ++frame) {
        const std::vector<double> values =
            file.finite_block(dataset, {frame, 0, 0, 0, 0}, {1, shape[1], shape[2], shape[3], 3});
        for (const double value : values) {
            if (std::abs(value) > largest)
                throw error(path, fmt::format("{} holds a velocity beyond 1e30 m/s", dataset));
            grid.velocities.push_back(static_cast<float>(value));
        }
    }
    grid.hash = file_content_hash(path);
    return grid;
}

void write_wind_file(const std::filesystem::path& path, const WindGrid& grid) {
    if (grid.size() * sizeof(double) > most_bytes) {
        throw Error(fmt::format("{}: would have {} GB; give the wind at fewer nodes or fewer times",
                                path.string(), (grid.size() * sizeof(double)) >> 30U));
    }
    write_hdf5(path, [&](Hdf5Writer& file) {
        const std::size_t frame_size = grid.size() / grid.frames;
        const std::vector<hsize_t> shape = {grid.frames, grid.nodes[2], grid.nodes[1], grid.nodes[0], 3};
        file.reserve(dataset, shape, {1, 1, shape[2], shape[3], 3}, "m/s",
                     "velocity of the air at (time, z, y, x)");
        for (std::size_t frame = 0; frame < grid.frames; ++frame) {
            const auto begin = grid.velocities.begin() + static_cast<std::ptrdiff_t>(frame * frame_size);
            file.write_block(dataset,
                             std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(frame_size)),
                             {frame, 0, 0, 0, 0}, {1, shape[1], shape[2], shape[3], 3});
        }
        const auto numbers = [](const Vector3d& v) { return std::vector<double>{v.x(), v.y(), v.z()}; };
        file.write("/wind/origin", numbers(grid.origin), {3}, "m", "the first node");
        file.write("/wind/spacing", numbers(grid.spacing), {3}, "m", "between nodes along x, y and z");
        file.attribute("/", "format_version", format_version);
        file.attribute("/", "samara_version", std::string_view(version));
        file.attribute("/", "kind", std::string_view("wind"));
        file.attribute("/wind", "interval", grid.interval);
        file.attribute("/wind", "source", grid.source);
    });
}

}  // namespace samara
