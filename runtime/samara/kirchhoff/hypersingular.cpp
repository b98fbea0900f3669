#include "samara/kirchhoff/hypersingular.hpp"

#include <Eigen/Cholesky>

#include "samara/base/error.hpp"
#include "samara/kirchhoff/linear_elements.hpp"
#include "samara/kirchhoff/rotation_loads.hpp"
#include "samara/kirchhoff/single_layer_matrix.hpp"

namespace samara {
namespace {

constexpr std::size_t leaf_size = 64;

Eigen::Index at(std::size_t index) {
    return static_cast<Eigen::Index>(index);
}

/// The normals, a row each triangle.
Eigen::Matrix<double, Eigen::Dynamic, 3> normals_of(const LinearElements& elements) {
    Eigen::Matrix<double, Eigen::Dynamic, 3> normals(at(elements.triangle_count()), 3);
    for (std::size_t t = 0; t < elements.triangle_count(); ++t) {
        normals.row(at(t)) = elements.triangles[t].normal.transpose();
    }
    return normals;
}

/// <n_k, v_i>, a row each node.
Eigen::Matrix<double, Eigen::Dynamic, 3> normal_loads(const LinearElements& elements) {
    Eigen::Matrix<double, Eigen::Dynamic, 3> loads =
        Eigen::Matrix<double, Eigen::Dynamic, 3>::Zero(at(elements.node_count()), 3);
    for (std::size_t t = 0; t < elements.triangle_count(); ++t) {
        const FlatTriangle& triangle = elements.triangles[t];
        for (std::size_t k = 0; k < 3; ++k) {
            loads.row(at(elements.node(t, k))) += triangle.area / 3.0 * triangle.normal.transpose();
        }
    }
    return loads;
}

Eigen::Matrix<double, Eigen::Dynamic, 3> coordinates_of(const LinearElements& elements) {
    Eigen::Matrix<double, Eigen::Dynamic, 3> coordinates(at(elements.node_count()), 3);
    for (std::size_t i = 0; i < elements.node_count(); ++i) {
        coordinates.row(at(i)) = elements.nodes[i].transpose();
    }
    return coordinates;
}

/// <g_a, S g_b> from the rotations' loads and from V for the translations.
Matrix6d single_layer_energies(const RotationLoads& rotations, const Matrix3d& translations) {
    Matrix6d energies;
    energies.topRows<3>() = rotations.energies;
    energies.bottomLeftCorner<3, 3>() = rotations.energies.rightCols<3>().transpose();
    energies.bottomRightCorner<3, 3>() = translations;
    return energies;
}

/// Adds the constants of each component, on which W vanishes, with a weight of the order of W's diagonal.
void regularise(const LinearElements& elements, RowMatrix& hypersingular) {
    std::vector<double> count(static_cast<std::size_t>(elements.component_count), 0.0);
    for (const std::int32_t component : elements.component) count[static_cast<std::size_t>(component)] += 1.0;
    const double scale = hypersingular.diagonal().mean();
    for (std::size_t i = 0; i < elements.node_count(); ++i) {
        for (std::size_t j = 0; j < elements.node_count(); ++j) {
            if (elements.component[i] != elements.component[j]) continue;
            hypersingular(at(i), at(j)) += scale / count[static_cast<std::size_t>(elements.component[i])];
        }
    }
}

std::function<void(double)> part_of(const std::function<void(double)>& progress, double begin, double end) {
    if (!progress) return {};
    return [=](double share) { progress(begin + share * (end - begin)); };
}

BoundaryElementResult solve_dense(const LinearElements& elements, const BoundaryElementOptions& options) {
    const SingleLayerEntries entries(elements.triangles);
    const RowMatrix single_layer =
        dense_single_layer(entries, options.threads, part_of(options.progress, 0.0, 0.5));
    RowMatrix hypersingular = dense_hypersingular(elements, single_layer, options.threads);
    const RotationLoads rotations =
        rotation_loads(elements, options.threads, part_of(options.progress, 0.6, 0.9));

    SixColumns loads(at(elements.node_count()), 6);
    loads.leftCols<3>() = rotations.loads;
    // (1/2 + D') n_k = n_k - W x_k, exactly: x_k is linear on each triangle.
    loads.rightCols<3>() = normal_loads(elements) - hypersingular * coordinates_of(elements);
    remove_component_sums(elements, loads);
    regularise(elements, hypersingular);
    const Eigen::LLT<Eigen::Ref<RowMatrix>> factors(hypersingular);
    if (factors.info() != Eigen::Success) {
        throw Error(
            "the boundary elements' matrix is not positive definite: the surface crosses itself or is not "
            "closed; mesh the shape again with 'samara mesh'");
    }
    const auto normals = normals_of(elements);
    Eigen::Matrix<double, Eigen::Dynamic, 3> areas_free = single_layer * normals;
    BoundaryElementResult result;
    result.tensor = single_layer_energies(rotations, normals.transpose() * areas_free);
    result.tensor += loads.transpose() * factors.solve(loads);
    result.closure_fault = rotations.closure_fault;
    result.unknowns = elements.node_count();
    result.memory = sizeof(double) * static_cast<std::size_t>(single_layer.size() + hypersingular.size());
    return result;
}

}  // namespace

BoundaryElementResult solve_hypersingular(const Surface& surface, const BoundaryElementOptions& options,
                                          const HypersingularOptions&) {
    return solve_dense(linear_elements(surface, leaf_size), options);
}

}  // namespace samara
