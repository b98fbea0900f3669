#include "meshes/remeshing/edge_middle.hpp"

#include <Eigen/Geometry>

namespace samara {
namespace {

constexpr int places = 9;                  // where the surface is looked at, besides the ends
constexpr double weight_of_ends = 10.0;    // of their heights, which are exact
constexpr double weight_of_middle = 0.01;  // where nothing bends the normals say nothing
constexpr int most_steps = 5;
constexpr int steps_to_place = 2;
constexpr double most_astray = 0.25;  // from the chord's middle, over its length
constexpr double least_turn = 1e-6;   // between the normals at the ends

/// The surface as a height over the edge, which goes from (-1/2, 0) to (1/2, 0): cubic along it. The cube of
/// y, which would turn all normals alike, is left out.
struct Height {
    static constexpr int terms = 9;
    Eigen::Matrix<double, terms, 1> coefficients;

    static Eigen::Matrix<double, 1, terms> monomials(double x, double y) {
        Eigen::Matrix<double, 1, terms> row;
        row << 1.0, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y;
        return row;
    }
    [[nodiscard]] Eigen::Vector2d slope(double x, double y) const {
        const auto& c = coefficients;
        return {c[1] + 2.0 * c[3] * x + c[4] * y + 3.0 * c[6] * x * x + 2.0 * c[7] * x * y + c[8] * y * y,
                c[2] + c[4] * x + 2.0 * c[5] * y + c[7] * x * x + 2.0 * c[8] * x * y};
    }
    [[nodiscard]] Eigen::Matrix2d bend(double x, double y) const {
        const auto& c = coefficients;
        const double mixed = c[4] + 2.0 * c[7] * x + 2.0 * c[8] * y;
        return (Eigen::Matrix2d() << 2.0 * c[3] + 6.0 * c[6] * x + 2.0 * c[7] * y, mixed, mixed,
                2.0 * c[5] + 2.0 * c[8] * x)
            .finished();
    }
};

/// Gauss and Newton from the middle. Normals are between those at the ends where their slopes are on the line
/// through those of the ends.
std::optional<Eigen::Vector2d> place_of_middle(const Height& height) {
    const Eigen::Vector2d first = height.slope(-0.5, 0.0);
    const Eigen::Vector2d turn = height.slope(0.5, 0.0) - first;
    Eigen::Vector2d across(-turn.y(), turn.x());
    across = turn.norm() > least_turn ? Eigen::Vector2d(across / turn.norm()) : Eigen::Vector2d::Zero();
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
    for (int step = 0; step < most_steps; ++step) {
        const Eigen::Vector2d slope = height.slope(place.x(), place.y());
        const Eigen::Matrix2d bend = height.bend(place.x(), place.y());
        Eigen::Matrix<double, 4, 2> jacobian;
        jacobian << bend.row(0), across.transpose() * bend, weight_of_middle * Eigen::Matrix2d::Identity();
        Eigen::Vector4d residual;
        residual << slope.x(), across.dot(slope - first), weight_of_middle * place;
        const Eigen::Matrix2d normal_matrix = jacobian.transpose() * jacobian;
        place -= normal_matrix.inverse() * (jacobian.transpose() * residual);
        if (!(place.norm() < most_astray)) return std::nullopt;
    }
    return place;
}

}  // namespace

std::optional<Vector3d> middle_on_surface(const std::array<Vector3d, 2>& ends,
                                          const std::array<Vector3d, 2>& across, const LiftedPoint& lifted) {
    const Vector3d middle = 0.5 * (ends[0] + ends[1]);
    const double length = (ends[1] - ends[0]).norm();
    const Vector3d x = (ends[1] - ends[0]) / length;
    // Of the triangle on the left, and of that on the right.
    const Vector3d area = x.cross(across[0] - middle) - x.cross(across[1] - middle);
    const Vector3d z = area.normalized();
    const Vector3d y = z.cross(x);
    const double breadth = 0.5 * area.norm() / length;
    if (!(breadth > 0.0)) return std::nullopt;

    Eigen::Matrix<double, places + 2, Height::terms> rows;
    Eigen::Matrix<double, places + 2, 1> heights;
    const auto keep = [&](int i, const Vector3d& point, double weight) {
        const Vector3d arm = (point - middle) / length;
        rows.row(i) = weight * Height::monomials(arm.dot(x), arm.dot(y) / breadth);
        heights[i] = weight * arm.dot(z);
    };
    keep(places, ends[0], weight_of_ends);
    keep(places + 1, ends[1], weight_of_ends);
    int i = 0;
    for (const double along : {0.3, 0.5, 0.7}) {
        const Vector3d on_edge = ends[0] + along * (ends[1] - ends[0]);
        for (const Vector3d& start : {on_edge, Vector3d(on_edge + 0.25 * (across[0] - on_edge)),
                                      Vector3d(on_edge + 0.25 * (across[1] - on_edge))}) {
            const std::optional<Vector3d> point = lifted(start);
            if (!point) return std::nullopt;
            keep(i++, *point, 1.0);
        }
    }
    Height height;
    height.coefficients = rows.colPivHouseholderQr().solve(heights);
    // From units of the breadth.
    height.coefficients.array() /= Eigen::Array<double, Height::terms, 1>{
        1.0, 1.0, breadth, 1.0, breadth, breadth * breadth, 1.0, breadth, breadth * breadth};
    const std::optional<Eigen::Vector2d> place = place_of_middle(height);
    if (!place) return std::nullopt;
    // The surface need not be looked at along z.
    const Vector3d wanted = middle + length * (place->x() * x + place->y() * y);
    std::optional<Vector3d> found = lifted(wanted);
    Vector3d start = wanted;
    for (int step = 0; found && step < steps_to_place; ++step) {
        const Vector3d off = wanted - *found;
        start += off - off.dot(z) * z;
        found = lifted(start);
    }
    return found;
}

}  // namespace samara
