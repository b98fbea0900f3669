#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>

#include "converter/wind/wind_readers.hpp"
#include "samara/core/base/error.hpp"

namespace samara {
namespace {

Error error(const std::filesystem::path& file, const std::string& what) {
    return Error(fmt::format("{}: {}", file.string(), what));
}

/// Converts y up to z up, (x, y, z) -> (x, -z, y), and back.
openvdb::Vec3d z_up(const openvdb::Vec3d& v, bool y_up) {
    return y_up ? openvdb::Vec3d(v.x(), -v.z(), v.y()) : v;
}
openvdb::Vec3d as_in_file(const Vector3d& v, bool y_up) {
    return y_up ? openvdb::Vec3d(v.x(), v.z(), -v.y()) : openvdb::Vec3d(v.x(), v.y(), v.z());
}

/// The velocity of one file: a grid of vectors, or a grid of numbers for each component.
class VdbVelocity {
  public:
    VdbVelocity(const std::filesystem::path& file, const VdbOptions& options) : options_(options) {
        try {
            openvdb::io::File opened(file.string());
            opened.open(false);
            read(file, *opened.getGrids());
        } catch (const openvdb::Exception& failure) {
            throw error(file, fmt::format("cannot be read as OpenVDB: {}", failure.what()));
        }
        for (const openvdb::GridBase::Ptr& part : parts_) place(file, *part);
    }

    /// Returns the voxel size (m) in the file's axes.
    [[nodiscard]] openvdb::Vec3d voxel_size() const { return parts_.front()->voxelSize(); }

    /// Extends a box (m, z up) to contain the active voxels.
    void widen(Eigen::AlignedBox3d& box) const {
        for (const openvdb::GridBase::Ptr& part : parts_) {
            const openvdb::CoordBBox voxels = part->evalActiveVoxelBoundingBox();
            if (voxels.empty()) continue;
            for (int corner = 0; corner < 8; ++corner) {
                const openvdb::Coord at(corner & 1 ? voxels.max().x() : voxels.min().x(),
                                        corner & 2 ? voxels.max().y() : voxels.min().y(),
                                        corner & 4 ? voxels.max().z() : voxels.min().z());
                const openvdb::Vec3d there = z_up(part->indexToWorld(at), options_.y_up);
                box.extend(Vector3d(there.x(), there.y(), there.z()));
            }
        }
    }

    /// Returns the velocity (m/s, z up) at a place (m, z up).
    [[nodiscard]] Vector3d operator()(const Vector3d& place) const {
        const openvdb::Vec3d at = as_in_file(place, options_.y_up);
        openvdb::Vec3d found;
        if (parts_.size() == 1) {
            const auto& grid = static_cast<const openvdb::Vec3SGrid&>(*parts_.front());
            const openvdb::Vec3d index = grid.worldToIndex(at);
            found = grid.getGridClass() == openvdb::GRID_STAGGERED
                        ? openvdb::Vec3d(openvdb::tools::StaggeredBoxSampler::sample(grid.tree(), index))
                        : openvdb::Vec3d(openvdb::tools::BoxSampler::sample(grid.tree(), index));
        } else {
            for (int i = 0; i < 3; ++i) {
                const auto& grid =
                    static_cast<const openvdb::FloatGrid&>(*parts_[static_cast<std::size_t>(i)]);
                found[i] = openvdb::tools::BoxSampler::sample(grid.tree(), grid.worldToIndex(at));
            }
        }
        const openvdb::Vec3d up = z_up(found, options_.y_up);
        return {up.x(), up.y(), up.z()};
    }

  private:
    void read(const std::filesystem::path& file, const openvdb::GridPtrVec& grids) {
        std::vector<std::string> names;
        std::vector<openvdb::GridBase::Ptr> vectors;
        const auto of_name = [&](const std::string& name) {
            for (const openvdb::GridBase::Ptr& grid : grids) {
                if (grid->getName() == name) return grid;
            }
            return openvdb::GridBase::Ptr();
        };
        for (const openvdb::GridBase::Ptr& grid : grids) {
            names.push_back(grid->getName());
            if (grid->isType<openvdb::Vec3SGrid>()) vectors.push_back(grid);
        }
        std::vector<std::string> wanted = {"velocity", "vel", "v"};
        if (!options_.grid.empty()) wanted = {options_.grid};
        for (const std::string& name : wanted) {
            const openvdb::GridBase::Ptr whole = of_name(name);
            if (whole && whole->isType<openvdb::Vec3SGrid>()) parts_ = {whole};
            if (!parts_.empty()) return;
            for (const char* component : {".x", ".y", ".z"}) {
                const openvdb::GridBase::Ptr part = of_name(name + component);
                if (part && part->isType<openvdb::FloatGrid>()) parts_.push_back(part);
            }
            if (parts_.size() == 3) return;
            parts_.clear();
        }
        if (options_.grid.empty() && vectors.size() == 1) {
            parts_ = vectors;
            return;
        }
        const std::string held =
            names.empty() ? "no grids" : fmt::format("the grids {}", fmt::join(names, ", "));
        throw error(
            file,
            options_.grid.empty()
                ? fmt::format(
                      "holds {}, none of which is recognised as a velocity; name a vector grid with --grid",
                      held)
                : fmt::format("holds {}, but no single-precision velocity '{}'; give --grid", held,
                              options_.grid));
    }

    /// Sets the voxel size of a grid in index space. Throws Error where that is not given, or the grid is no
    /// box.
    void place(const std::filesystem::path& file, openvdb::GridBase& grid) const {
        if (!grid.transform().isLinear()) {
            throw error(file,
                        fmt::format("the grid '{}' is a frustum; resample it to a box", grid.getName()));
        }
        const bool in_index_space = grid.transform().isIdentity();
        if (in_index_space && !options_.voxel_size) {
            throw error(file, fmt::format("the grid '{}' is in index space and does not define its voxel "
                                          "size; give --voxel-size in metres",
                                          grid.getName()));
        }
        if (in_index_space)
            grid.setTransform(openvdb::math::Transform::createLinearTransform(*options_.voxel_size));
    }

    const VdbOptions& options_;
    std::vector<openvdb::GridBase::Ptr> parts_;
};

void append(const VdbVelocity& velocity, const std::filesystem::path& file, WindGrid& grid) {
    for (std::size_t z = 0; z < grid.nodes[2]; ++z) {
        for (std::size_t y = 0; y < grid.nodes[1]; ++y) {
            for (std::size_t x = 0; x < grid.nodes[0]; ++x) {
                const Vector3d steps(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
                const Vector3d place = grid.origin + steps.cwiseProduct(grid.spacing);
                const Vector3d there = velocity(place);
                if (!there.allFinite()) {
                    throw error(
                        file,
                        fmt::format(
                            "the velocity at ({:.4g}, {:.4g}, {:.4g}) m is not finite; export the grid again",
                            place.x(), place.y(), place.z()));
                }
                for (Eigen::Index i = 0; i < 3; ++i) grid.velocities.push_back(static_cast<float>(there[i]));
            }
        }
    }
}

}  // namespace

WindGrid read_vdb_wind(const std::vector<std::filesystem::path>& files, const VdbOptions& options) {
    if (files.empty()) throw Error("no .vdb file was given; give one");
    openvdb::initialize();
    WindGrid grid;
    grid.frames = files.size();
    grid.interval = 1.0 / options.frame_rate;
    Eigen::AlignedBox3d box;
    std::optional<openvdb::Vec3d> voxel;
    // The files are read twice, so that memory does not grow with their number.
    const auto total = 2.0 * static_cast<double>(files.size());
    double done = 0.0;
    const auto report = [&] {
        if (options.progress) options.progress(++done, total);
    };
    for (const std::filesystem::path& file : files) {
        const VdbVelocity velocity(file, options);
        if (!voxel) voxel = velocity.voxel_size();
        velocity.widen(box);
        report();
    }
    if (box.isEmpty()) throw error(files.front(), "none of the files has an active voxel; export them again");
    const openvdb::Vec3d size = z_up(*voxel, options.y_up);
    grid.spacing = Vector3d(size.x(), size.y(), size.z()).cwiseAbs();
    if (options.spacing) grid.spacing.setConstant(*options.spacing);
    lay_nodes(grid, box);
    grid.velocities.reserve(grid.size());
    for (const std::filesystem::path& file : files) {
        append(VdbVelocity(file, options), file, grid);
        report();
    }
    grid.source = fmt::format("{}{} by OpenVDB {}", files.front().filename().string(),
                              files.size() > 1 ? fmt::format(" and {} more", files.size() - 1) : "",
                              openvdb::getLibraryVersionString());
    return grid;
}

}  // namespace samara
