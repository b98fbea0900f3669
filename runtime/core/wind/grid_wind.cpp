#include "samara/core/wind/grid_wind.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace samara {
namespace {

/// The nodes along one axis that shape the value at a coordinate, and by how much.
struct AxisWeights {
    std::size_t node[4] = {};
    double value[4] = {};
    double slope[4] = {};  ///< of the value, for one node's distance
    int count = 0;
};

/// What is beyond the first and last node.
enum class Beyond { edge, nothing, first };

/// Weights of Keys' cubic convolution with a = -1/2. `at`: in nodes from the first.
AxisWeights axis_weights(double at, std::size_t nodes, Beyond beyond) noexcept {
    AxisWeights weights;
    const auto last = static_cast<double>(nodes - 1);
    bool is_level = false;
    if (beyond == Beyond::edge) {
        is_level = at < 0.0 || at > last || nodes == 1;
        at = std::clamp(at, 0.0, last);
    } else if (beyond == Beyond::first) {
        const auto period = static_cast<double>(nodes);
        at -= period * std::floor(at / period);
    } else if (!(at > -1.0 && at < last + 1.0)) {
        return weights;
    }
    const double floor = std::floor(at);
    const double t = at - floor;
    const auto first = static_cast<std::ptrdiff_t>(floor) - 1;
    const double t2 = t * t;
    const double t3 = t2 * t;
    const double value[4] = {-0.5 * t + t2 - 0.5 * t3, 1.0 - 2.5 * t2 + 1.5 * t3,
                             0.5 * t + 2.0 * t2 - 1.5 * t3, -0.5 * t2 + 0.5 * t3};
    const double slope[4] = {-0.5 + 2.0 * t - 1.5 * t2, -5.0 * t + 4.5 * t2, 0.5 + 4.0 * t - 4.5 * t2,
                             -t + 1.5 * t2};
    const auto add = [&](std::ptrdiff_t node, double v, double s) {
        weights.node[weights.count] = static_cast<std::size_t>(node);
        weights.value[weights.count] = v;
        weights.slope[weights.count++] = is_level ? 0.0 : s;
    };
    const auto end = static_cast<std::ptrdiff_t>(nodes);
    if (beyond == Beyond::edge && nodes == 1) {
        add(0, 1.0, 0.0);
        return weights;
    }
    if (beyond == Beyond::edge && (first < 0 || first + 3 >= end)) {
        // A node beyond the edge goes on straight: it is twice the last less the one before.
        double values[4] = {value[0], value[1], value[2], value[3]};
        double slopes[4] = {slope[0], slope[1], slope[2], slope[3]};
        const auto fold = [&](int ghost, int near, int far) {
            values[near] += 2.0 * values[ghost];
            slopes[near] += 2.0 * slopes[ghost];
            values[far] -= values[ghost];
            slopes[far] -= slopes[ghost];
            values[ghost] = slopes[ghost] = 0.0;
        };
        for (int i = 3; i >= 2; --i) {
            if (first + i >= end) fold(i, i - 1, i - 2);
        }
        if (first < 0) fold(0, 1, 2);
        for (int i = 0; i < 4; ++i) {
            if (first + i >= 0 && first + i < end) add(first + i, values[i], slopes[i]);
        }
        return weights;
    }
    for (int i = 0; i < 4; ++i) {
        std::ptrdiff_t node = first + i;
        if (beyond == Beyond::first) node = ((node % end) + end) % end;
        if (node >= 0 && node < end) add(node, value[i], slope[i]);
    }
    return weights;
}

}  // namespace

GridWind grid_wind(const WindFile& file, const Vector3d& place, double time) noexcept {
    const WindGrid& grid = *file.grid;
    const Vector3d at = (place - file.position - grid.origin).cwiseQuotient(grid.spacing);
    const Beyond beyond = file.outside == WindFile::Outside::still ? Beyond::nothing : Beyond::edge;
    const AxisWeights x = axis_weights(at.x(), grid.nodes[0], beyond);
    const AxisWeights y = axis_weights(at.y(), grid.nodes[1], beyond);
    const AxisWeights z = axis_weights(at.z(), grid.nodes[2], beyond);
    const AxisWeights t = axis_weights((time - file.start) / grid.interval, grid.frames,
                                       file.repeats ? Beyond::first : Beyond::edge);
    Vector3d velocity = Vector3d::Zero();
    Vector3d rate = Vector3d::Zero();
    Matrix3d gradient = Matrix3d::Zero();  // for one node's distance
    for (int l = 0; l < t.count; ++l) {
        Vector3d volume[4] = {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
        for (int k = 0; k < z.count; ++k) {
            Vector3d layer[3] = {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
            for (int j = 0; j < y.count; ++j) {
                const std::size_t row =
                    ((t.node[l] * grid.nodes[2] + z.node[k]) * grid.nodes[1] + y.node[j]) * grid.nodes[0];
                Vector3d value = Vector3d::Zero();
                Vector3d slope = Vector3d::Zero();
                for (int i = 0; i < x.count; ++i) {
                    const float* node = &grid.velocities[(row + x.node[i]) * 3];
                    const Vector3d there(node[0], node[1], node[2]);
                    value += x.value[i] * there;
                    slope += x.slope[i] * there;
                }
                layer[0] += y.value[j] * value;
                layer[1] += y.value[j] * slope;
                layer[2] += y.slope[j] * value;
            }
            volume[0] += z.value[k] * layer[0];
            volume[1] += z.value[k] * layer[1];
            volume[2] += z.value[k] * layer[2];
            volume[3] += z.slope[k] * layer[0];
        }
        velocity += t.value[l] * volume[0];
        rate += t.slope[l] * volume[0];
        for (int axis = 0; axis < 3; ++axis) gradient.col(axis) += t.value[l] * volume[axis + 1];
    }
    return {velocity, gradient * grid.spacing.cwiseInverse().asDiagonal(), rate / grid.interval};
}

}  // namespace samara
