#include "samara/kirchhoff/solvers/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include <Eigen/Cholesky>

#include "samara/core/base/parallel_for.hpp"

namespace samara {
namespace {

constexpr int most_iterations = 300;
constexpr double least_scale = 1e-3;  // of the block's largest

Vector6d products(const SixColumns& a, const SixColumns& b) {
    return a.cwiseProduct(b).colwise().sum().transpose();
}

/// Returns a / b; 0 where b is 0, which is so for columns of zeros alone.
Vector6d ratios(const Vector6d& a, const Vector6d& b) {
    return (b.array() != 0.0).select(a.cwiseQuotient(b), Vector6d::Zero());
}

/// Returns the energy that may be left in each column.
Vector6d allowed(const Vector6d& energies, double tolerance) {
    Vector6d result;
    for (const Eigen::Index block : {0, 3}) {
        const double floor = least_scale * energies.segment<3>(block).maxCoeff();
        result.segment<3>(block) = tolerance * energies.segment<3>(block).cwiseMax(floor);
    }
    return result;
}

// Added to the diagonal, relative to its mean: where a cluster is a whole component, its constants have no
// resistance at all, or where V is rounded to single precision, as much below zero.
constexpr double least_shift = 1e-9;
constexpr double most_shift = 1e-6;

using NodeTriangles = std::vector<std::vector<std::size_t>>;

NodeTriangles triangles_of_nodes(const LinearElements& elements) {
    NodeTriangles result(elements.node_count());
    for (std::size_t t = 0; t < elements.triangle_count(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) result[elements.node(t, k)].push_back(t);
    }
    return result;
}

void sort_and_weed(std::vector<std::size_t>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

std::vector<std::size_t> nodes_of(const LinearElements& elements, const std::vector<std::size_t>& triangles) {
    std::vector<std::size_t> nodes;
    for (const std::size_t t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) nodes.push_back(elements.node(t, k));
    }
    sort_and_weed(nodes);
    return nodes;
}

std::vector<std::size_t> triangles_at(const NodeTriangles& triangles, const std::vector<std::size_t>& nodes) {
    std::vector<std::size_t> result;
    for (const std::size_t node : nodes) {
        result.insert(result.end(), triangles[node].begin(), triangles[node].end());
    }
    sort_and_weed(result);
    return result;
}

Eigen::MatrixXd local_hypersingular(const LinearElements& elements, const Eigen::MatrixXd& single_layer,
                                    const std::vector<std::size_t>& nodes,
                                    const std::vector<std::size_t>& triangles) {
    std::unordered_map<std::size_t, Eigen::Index> place;
    for (std::size_t i = 0; i < nodes.size(); ++i) place[nodes[i]] = eigen_index(i);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(eigen_index(nodes.size()), eigen_index(nodes.size()));
    std::vector<std::array<Eigen::Index, 3>> places(triangles.size());  // -1: a node of other clusters alone
    std::vector<std::array<Vector3d, 3>> curls(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto found = place.find(elements.node(triangles[t], k));
            places[t][k] = found == place.end() ? -1 : found->second;
            curls[t][k] = elements.curl(triangles[t], k);
        }
    }
    Eigen::Matrix<double, 3, Eigen::Dynamic> row(3, eigen_index(nodes.size()));
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        row.setZero();
        for (std::size_t s = 0; s < triangles.size(); ++s) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (places[s][k] >= 0)
                    row.col(places[s][k]) += single_layer(eigen_index(s), eigen_index(t)) * curls[s][k];
            }
        }
        for (std::size_t k = 0; k < 3; ++k) {
            if (places[t][k] >= 0) matrix.col(places[t][k]) += row.transpose() * curls[t][k];
        }
    }
    return matrix;
}

/// Returns Cholesky's factor of the matrix.
Eigen::MatrixXd lower_factor(const Eigen::MatrixXd& matrix) {
    for (double shift = least_shift;; shift *= 100.0) {
        Eigen::MatrixXd shifted = matrix;
        shifted.diagonal().array() += shift * matrix.diagonal().mean();
        const Eigen::LLT<Eigen::MatrixXd> factors(shifted);
        if (factors.info() == Eigen::Success || shift > most_shift) return factors.matrixL();
    }
}

/// Returns the largest clusters of the tree of no more than `size` triangles.
std::vector<Cluster> clusters_up_to(const ClusterTree& tree, std::size_t size) {
    std::vector<Cluster> result;
    std::vector<std::size_t> open = {0};
    while (!open.empty()) {
        const Cluster& cluster = tree.clusters[open.back()];
        open.pop_back();
        if (cluster.size() <= size || cluster.is_leaf()) {
            result.push_back(cluster);
        } else {
            open.push_back(cluster.right);
            open.push_back(cluster.left);
        }
    }
    return result;
}

}  // namespace

std::optional<SolutionEnergies> conjugate_gradients(
    const std::function<SixColumns(const SixColumns&)>& multiply,
    const std::function<SixColumns(const SixColumns&)>& precondition, const SixColumns& right_hand_sides,
    const Vector6d& scales, double tolerance, const std::function<void(double)>& progress) {
    SixColumns solution = SixColumns::Zero(right_hand_sides.rows(), 6);
    SixColumns image = solution;  // multiply(solution)
    SixColumns residual = right_hand_sides;
    SixColumns conditioned = precondition(residual);
    SixColumns direction = conditioned;
    Vector6d left = products(residual, conditioned);
    Vector6d energies = scales;
    SolutionEnergies result;
    double first_excess = 0.0;
    for (;; ++result.iterations) {
        const double excess = ratios(left, allowed(energies, tolerance)).maxCoeff();
        if (!std::isfinite(excess)) return std::nullopt;
        if (result.iterations > 0 && excess <= 1.0) break;
        if (result.iterations == most_iterations) return std::nullopt;
        if (result.iterations == 1) first_excess = excess;
        if (progress && first_excess > 1.0) {
            progress(std::clamp(1.0 - std::log(excess) / std::log(first_excess), 0.0, 1.0));
        }
        const SixColumns step_image = multiply(direction);
        const Vector6d curvature = products(direction, step_image);
        if ((curvature.array() < 0.0).any()) return std::nullopt;
        const Vector6d step = ratios(left, curvature);
        solution += direction * step.asDiagonal();
        image += step_image * step.asDiagonal();
        residual -= step_image * step.asDiagonal();
        energies += step.cwiseProduct(left);
        conditioned = precondition(residual);
        const Vector6d next = products(residual, conditioned);
        direction = (conditioned + direction * ratios(next, left).asDiagonal()).eval();
        left = next;
    }
    const Matrix6d linear = solution.transpose() * right_hand_sides;
    result.energies = linear + linear.transpose() - solution.transpose() * image;
    return result;
}

SchwarzPreconditioner::SchwarzPreconditioner(const LinearElements& elements,
                                             const SingleLayerPart& single_layer, std::size_t cluster_size,
                                             int threads) {
    const NodeTriangles triangles = triangles_of_nodes(elements);
    const std::vector<Cluster> clusters = clusters_up_to(elements.tree, cluster_size);
    parts_.resize(clusters.size());
    parallel_for(clusters.size(), 1, threads, [&](std::size_t c, std::size_t) {
        std::vector<std::size_t> own(clusters[c].size());
        for (std::size_t i = 0; i < own.size(); ++i) own[i] = clusters[c].begin + i;
        Part& part = parts_[c];
        part.nodes = nodes_of(elements, own);
        const std::vector<std::size_t> around = triangles_at(triangles, part.nodes);
        part.factor = lower_factor(local_hypersingular(elements, single_layer(around), part.nodes, around));
    });
}

SixColumns SchwarzPreconditioner::apply(const SixColumns& residuals, int threads) const {
    std::vector<Eigen::MatrixXd> solutions(parts_.size());
    parallel_for(parts_.size(), 1, threads, [&](std::size_t p, std::size_t) {
        const Part& part = parts_[p];
        Eigen::MatrixXd local(eigen_index(part.nodes.size()), 6);
        for (std::size_t i = 0; i < part.nodes.size(); ++i)
            local.row(eigen_index(i)) = residuals.row(eigen_index(part.nodes[i]));
        const auto lower = part.factor.triangularView<Eigen::Lower>();
        lower.solveInPlace(local);
        lower.transpose().solveInPlace(local);
        solutions[p] = std::move(local);
    });
    SixColumns result = SixColumns::Zero(residuals.rows(), 6);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        for (std::size_t i = 0; i < parts_[p].nodes.size(); ++i) {
            result.row(eigen_index(parts_[p].nodes[i])) += solutions[p].row(eigen_index(i));
        }
    }
    return result;
}

std::size_t SchwarzPreconditioner::memory() const {
    std::size_t doubles = 0;
    for (const Part& part : parts_) doubles += static_cast<std::size_t>(part.factor.size());
    return doubles * sizeof(double);
}

}  // namespace samara
