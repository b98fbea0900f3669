#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "converter/openfoam/foam_history.hpp"
#include "converter/openfoam/poly_mesh.hpp"
#include "converter/wind/wind_readers.hpp"
#include "samara/core/base/error.hpp"

namespace samara {
namespace {

constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();

/// Converts y up to z up: (x, y, z) -> (x, -z, y).
Vector3d z_up(const Vector3d& v, bool y_up) {
    return y_up ? Vector3d(v.x(), -v.z(), v.y()) : v;
}

/// A face of a cell.
struct CellFace {
    FaceGeometry geometry;  ///< area vector out of the cell
    std::size_t neighbour;  ///< the cell behind it, or nowhere
};

/// The mesh as a list of cells with their faces.
class Cells {
  public:
    explicit Cells(const PolyMesh& mesh) : faces_(mesh.cell_count()), boxes_(mesh.cell_count()) {
        for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
            const std::vector<Vector3d> corners = mesh.corners(face);
            FaceGeometry geometry = face_geometry(corners);
            const auto owner = static_cast<std::size_t>(mesh.owner[face]);
            const bool is_inside = face < mesh.neighbour.size();
            const std::size_t neighbour =
                is_inside ? static_cast<std::size_t>(mesh.neighbour[face]) : nowhere;
            add(owner, {geometry, neighbour}, corners);
            if (!is_inside) continue;
            geometry.area = -geometry.area;
            add(neighbour, {geometry, owner}, corners);
        }
        for (const std::vector<CellFace>& faces : faces_) centers_.push_back(center_of(faces));
    }

    [[nodiscard]] std::size_t size() const { return faces_.size(); }
    [[nodiscard]] const std::vector<CellFace>& faces(std::size_t cell) const { return faces_[cell]; }
    [[nodiscard]] const Vector3d& center(std::size_t cell) const { return centers_[cell]; }
    [[nodiscard]] const Eigen::AlignedBox3d& box(std::size_t cell) const { return boxes_[cell]; }
    /// Returns the distance (m) of a place beyond the cell's farthest face; negative inside.
    [[nodiscard]] double beyond(std::size_t cell, const Vector3d& place) const {
        double farthest = -std::numeric_limits<double>::infinity();
        for (const CellFace& face : faces_[cell]) {
            const double distance = (place - face.geometry.center).dot(face.geometry.area.normalized());
            farthest = std::max(farthest, distance);
        }
        return farthest;
    }

  private:
    void add(std::size_t cell, const CellFace& face, const std::vector<Vector3d>& corners) {
        faces_[cell].push_back(face);
        for (const Vector3d& corner : corners) boxes_[cell].extend(corner);
    }
    /// Returns the centroid of a cell, by pyramids about the mean of its faces.
    static Vector3d center_of(const std::vector<CellFace>& faces) {
        Vector3d middle = Vector3d::Zero();
        for (const CellFace& face : faces) middle += face.geometry.center / static_cast<double>(faces.size());
        double volume = 0.0;
        Vector3d moment = Vector3d::Zero();
        for (const CellFace& face : faces) {
            const double pyramid = face.geometry.area.dot(face.geometry.center - middle) / 3.0;
            volume += pyramid;
            moment += pyramid * (0.75 * face.geometry.center + 0.25 * middle);
        }
        return volume > 0.0 ? Vector3d(moment / volume) : middle;
    }

    std::vector<std::vector<CellFace>> faces_;
    std::vector<Eigen::AlignedBox3d> boxes_;
    std::vector<Vector3d> centers_;
};

Vector3d place_of(const WindGrid& grid, std::size_t x, std::size_t y, std::size_t z) {
    const Vector3d steps(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
    return grid.origin + steps.cwiseProduct(grid.spacing);
}

/// Returns the cell that contains each node, or nowhere; of several, the one in which it lies deepest.
std::vector<std::size_t> cells_of_nodes(const Cells& cells, const WindGrid& grid) {
    const std::size_t nodes = grid.nodes[0] * grid.nodes[1] * grid.nodes[2];
    std::vector<std::size_t> found(nodes, nowhere);
    std::vector<double> depth(nodes, std::numeric_limits<double>::infinity());
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        const Eigen::AlignedBox3d& box = cells.box(cell);
        const double tolerance = 1e-3 * box.sizes().minCoeff();  // faces are not quite plane
        std::size_t from[3];
        std::size_t to[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<Eigen::Index>(axis);
            const double last = static_cast<double>(grid.nodes[axis]) - 1.0;
            const double low = (box.min()[i] - tolerance - grid.origin[i]) / grid.spacing[i];
            const double high = (box.max()[i] + tolerance - grid.origin[i]) / grid.spacing[i];
            from[axis] = static_cast<std::size_t>(std::clamp(std::ceil(low), 0.0, last + 1.0));
            to[axis] = static_cast<std::size_t>(std::clamp(std::floor(high) + 1.0, 0.0, last + 1.0));
        }
        for (std::size_t z = from[2]; z < to[2]; ++z) {
            for (std::size_t y = from[1]; y < to[1]; ++y) {
                for (std::size_t x = from[0]; x < to[0]; ++x) {
                    const double beyond = cells.beyond(cell, place_of(grid, x, y, z));
                    const std::size_t node = (z * grid.nodes[1] + y) * grid.nodes[0] + x;
                    if (beyond > tolerance || beyond >= depth[node]) continue;
                    depth[node] = beyond;
                    found[node] = cell;
                }
            }
        }
    }
    return found;
}

/// Returns the velocity at a place in a cell.
Vector3d velocity_at(const Cells& cells, const FoamField<Vector3d>& field, std::size_t cell,
                     const Vector3d& place) {
    const Vector3d own = field[cell];
    Matrix3d squares = Matrix3d::Zero();
    Matrix3d products = Matrix3d::Zero();
    Vector3d least = own;
    Vector3d most = own;
    for (const CellFace& face : cells.faces(cell)) {
        if (face.neighbour == nowhere) continue;
        const Vector3d offset = cells.center(face.neighbour) - cells.center(cell);
        const Vector3d change = field[face.neighbour] - own;
        const double weight = 1.0 / offset.squaredNorm();
        squares += weight * offset * offset.transpose();
        products += weight * change * offset.transpose();
        least = least.cwiseMin(field[face.neighbour]);
        most = most.cwiseMax(field[face.neighbour]);
    }
    // Where the neighbours lie in a plane or on a line, the gradient perpendicular to it is zero.
    const Matrix3d gradient =
        squares.completeOrthogonalDecomposition().solve(products.transpose()).transpose();
    const Vector3d there = own + gradient * (place - cells.center(cell));
    return there.cwiseMax(least).cwiseMin(most);
}

std::vector<TimeFolder> times_of(const std::filesystem::path& case_folder, bool latest) {
    std::vector<TimeFolder> times;
    for (const TimeFolder& time : time_folders(case_folder)) {
        const bool has_velocity =
            std::filesystem::exists(time.path / "U") || std::filesystem::exists(time.path / "U.gz");
        if (has_velocity) times.push_back(time);
    }
    if (times.empty()) {
        throw Error(
            fmt::format("{}: has no time folder with a velocity U; solve the case, or reconstruct it with "
                        "reconstructPar",
                        case_folder.string()));
    }
    if (latest) times.erase(times.begin(), times.end() - 1);
    if (times.size() < 3) return times;
    const double interval = (times.back().time - times.front().time) / static_cast<double>(times.size() - 1);
    for (std::size_t i = 1; i < times.size(); ++i) {
        const double difference = times[i].time - times[i - 1].time;
        if (std::abs(difference - interval) <= 1e-3 * interval) continue;
        throw Error(
            fmt::format("{}: its times are not equally spaced ({:g} s before this one, {:g} s on average); "
                        "write the case at equal intervals, or use --latest",
                        times[i].path.string(), difference, interval));
    }
    return times;
}

}  // namespace

WindGrid read_foam_wind(const std::filesystem::path& case_folder, const FoamWindOptions& options) {
    PolyMesh mesh = read_poly_mesh(case_folder / "constant" / "polyMesh");
    Eigen::AlignedBox3d box;
    for (Vector3d& point : mesh.points) {
        point = z_up(point, options.y_up);
        box.extend(point);
    }
    const std::vector<TimeFolder> times = times_of(case_folder, options.latest);
    WindGrid grid;
    grid.frames = times.size();
    if (times.size() > 1) {
        grid.interval = (times.back().time - times.front().time) / static_cast<double>(times.size() - 1);
    }
    grid.spacing.setConstant(options.spacing);
    lay_nodes(grid, options.box.value_or(box));
    const Cells cells(mesh);
    const std::vector<std::size_t> found = cells_of_nodes(cells, grid);
    if (std::all_of(found.begin(), found.end(), [](std::size_t cell) { return cell == nowhere; })) {
        throw Error(fmt::format("{}: no node lies in the mesh; give another --box or a smaller --spacing",
                                case_folder.string()));
    }
    grid.velocities.reserve(grid.size());
    for (std::size_t frame = 0; frame < times.size(); ++frame) {
        const FoamField<Vector3d> field = read_vector_field(times[frame].path / "U");
        if (!field.covers(cells.size() - 1)) {
            throw Error(fmt::format("{}: has fewer values than the mesh has cells; copy the case again",
                                    (times[frame].path / "U").string()));
        }
        for (std::size_t node = 0; node < found.size(); ++node) {
            Vector3d velocity = Vector3d::Zero();
            if (found[node] != nowhere) {
                const std::size_t row = node / grid.nodes[0];
                const Vector3d place =
                    place_of(grid, node % grid.nodes[0], row % grid.nodes[1], row / grid.nodes[1]);
                velocity = z_up(velocity_at(cells, field, found[node], place), options.y_up);
            }
            for (Eigen::Index i = 0; i < 3; ++i) grid.velocities.push_back(static_cast<float>(velocity[i]));
        }
        if (options.progress)
            options.progress(static_cast<double>(frame + 1), static_cast<double>(times.size()));
    }
    grid.source = fmt::format("the OpenFOAM case {}",
                              std::filesystem::absolute(case_folder).lexically_normal().filename().string());
    return grid;
}

void lay_nodes(WindGrid& grid, const Eigen::AlignedBox3d& box) {
    constexpr double most_nodes = 4e8;  // 4.8 GB
    grid.origin = box.min();
    auto nodes = static_cast<double>(grid.frames);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<Eigen::Index>(axis);
        const double intervals = std::ceil(box.sizes()[i] / grid.spacing[i] - 1e-6);
        nodes *= intervals + 1.0;
        if (nodes > most_nodes) {
            throw Error(
                fmt::format("the wind would have more than {:g} nodes over all times; give a larger "
                            "--spacing than {:g} m",
                            most_nodes, grid.spacing.minCoeff()));
        }
        grid.nodes[axis] = static_cast<std::size_t>(intervals) + 1;
    }
}

}  // namespace samara
