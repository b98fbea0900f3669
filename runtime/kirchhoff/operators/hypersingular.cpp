#include "samara/kirchhoff/operators/hypersingular.hpp"

#include <algorithm>

#include <Eigen/Cholesky>

#include "samara/core/base/error.hpp"
#include "samara/core/base/parallel_for.hpp"
#include "samara/kirchhoff/operators/compressed_matrix.hpp"
#include "samara/kirchhoff/operators/rotation_loads.hpp"
#include "samara/kirchhoff/panels/linear_elements.hpp"
#include "samara/kirchhoff/solvers/conjugate_gradients.hpp"

namespace samara {
namespace {

constexpr std::size_t rows_a_piece = 16;

/// A triangle and which of its corners a node is.
struct Corner {
    std::size_t triangle;
    std::size_t corner;
};

std::vector<std::vector<Corner>> corners_of_nodes(const LinearElements& elements) {
    std::vector<std::vector<Corner>> result(elements.node_count());
    for (std::size_t t = 0; t < elements.triangle_count(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) result[elements.node(t, k)].push_back({t, k});
    }
    return result;
}

/// Returns W p = sum over triangles of curl v_i . V curl p for six columns, V compressed.
SixColumns hypersingular_times(const LinearElements& elements, const CompressedMatrix& single_layer,
                               const SixColumns& columns, int threads) {
    CurlColumns curls(eigen_index(elements.triangle_count()), 18);
    for (std::size_t t = 0; t < elements.triangle_count(); ++t) {
        Eigen::Matrix<double, 3, 6> sum = Eigen::Matrix<double, 3, 6>::Zero();
        for (std::size_t k = 0; k < 3; ++k) {
            sum += elements.curl(t, k) * columns.row(eigen_index(elements.node(t, k)));
        }
        for (Eigen::Index c = 0; c < 18; ++c)
            curls(eigen_index(t), c) = static_cast<float>(sum(c / 6, c % 6));
    }
    const CurlColumns products = single_layer.times(curls, threads);
    SixColumns result = SixColumns::Zero(eigen_index(elements.node_count()), 6);
    for (std::size_t t = 0; t < elements.triangle_count(); ++t) {
        Eigen::Matrix<double, 3, 6> product;
        for (Eigen::Index c = 0; c < 18; ++c)
            product(c / 6, c % 6) = static_cast<double>(products(eigen_index(t), c));
        for (std::size_t k = 0; k < 3; ++k) {
            result.row(eigen_index(elements.node(t, k))) += elements.curl(t, k).transpose() * product;
        }
    }
    return result;
}

constexpr std::size_t leaf_size = 64;         // triangles
constexpr std::size_t schwarz_cluster = 512;  // triangles
constexpr const char* unsolvable =
    "the boundary-element equations have no solution: the surface intersects itself or is not closed; mesh "
    "the shape again with 'samara mesh'";

/// Returns the normals, a row each triangle.
Eigen::Matrix<double, Eigen::Dynamic, 3> normals_of(const LinearElements& elements) {
    Eigen::Matrix<double, Eigen::Dynamic, 3> normals(eigen_index(elements.triangle_count()), 3);
    for (std::size_t t = 0; t < elements.triangle_count(); ++t) {
        normals.row(eigen_index(t)) = elements.triangles[t].normal.transpose();
    }
    return normals;
}

/// Returns <n_k, v_i>, a row each node.
Eigen::Matrix<double, Eigen::Dynamic, 3> normal_loads(const LinearElements& elements) {
    Eigen::Matrix<double, Eigen::Dynamic, 3> loads =
        Eigen::Matrix<double, Eigen::Dynamic, 3>::Zero(eigen_index(elements.node_count()), 3);
    for (std::size_t t = 0; t < elements.triangle_count(); ++t) {
        const FlatTriangle& triangle = elements.triangles[t];
        for (std::size_t k = 0; k < 3; ++k) {
            loads.row(eigen_index(elements.node(t, k))) += triangle.area / 3.0 * triangle.normal.transpose();
        }
    }
    return loads;
}

Eigen::Matrix<double, Eigen::Dynamic, 3> coordinates_of(const LinearElements& elements) {
    Eigen::Matrix<double, Eigen::Dynamic, 3> coordinates(eigen_index(elements.node_count()), 3);
    for (std::size_t i = 0; i < elements.node_count(); ++i) {
        coordinates.row(eigen_index(i)) = elements.nodes[i].transpose();
    }
    return coordinates;
}

/// Returns <g_a, S g_b> from the rotations' loads and from V for the translations.
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
            hypersingular(eigen_index(i), eigen_index(j)) +=
                scale / count[static_cast<std::size_t>(elements.component[i])];
        }
    }
}

std::function<void(double)> part_of(const std::function<void(double)>& progress, double begin, double end) {
    if (!progress) return {};
    return [=](double share) { progress(begin + share * (end - begin)); };
}

/// Returns the columns of the right-hand sides; (1/2 + D') n_k = n_k - W x_k exactly, because x_k is linear
/// on each triangle.
SixColumns all_loads(const LinearElements& elements, const RotationLoads& rotations,
                     const Eigen::Matrix<double, Eigen::Dynamic, 3>& coordinate_loads) {
    SixColumns loads(eigen_index(elements.node_count()), 6);
    loads.leftCols<3>() = rotations.loads;
    loads.rightCols<3>() = normal_loads(elements) - coordinate_loads;
    remove_component_sums(elements, loads);
    return loads;
}

/// W's matrix, regularised, and the right-hand sides for which it is solved.
struct DenseEquations {
    RowMatrix hypersingular;
    SixColumns loads;
    RotationLoads rotations;
    Matrix3d translation_energies;
    std::size_t memory = 0;
};

DenseEquations dense_equations(const LinearElements& elements, const BoundaryElementOptions& options) {
    const SingleLayerEntries entries(elements.triangles);
    const RowMatrix single_layer =
        dense_single_layer(entries, options.threads, part_of(options.progress, 0.0, 0.5));
    DenseEquations equations;
    equations.hypersingular = dense_hypersingular(elements, single_layer, options.threads);
    equations.rotations = rotation_loads(elements, options.threads, part_of(options.progress, 0.6, 0.9));
    equations.loads =
        all_loads(elements, equations.rotations, equations.hypersingular * coordinates_of(elements));
    const auto normals = normals_of(elements);
    equations.translation_energies = normals.transpose() * (single_layer * normals);
    equations.memory =
        sizeof(double) * static_cast<std::size_t>(single_layer.size() + equations.hypersingular.size());
    regularise(elements, equations.hypersingular);
    return equations;
}

/// Returns W^-1 of the right-hand sides; the equations' matrix is overwritten.
SixColumns solved(DenseEquations& equations) {
    const Eigen::LLT<Eigen::Ref<RowMatrix>> factors(equations.hypersingular);
    if (factors.info() != Eigen::Success) throw Error(unsolvable);
    return factors.solve(equations.loads);
}

BoundaryElementResult solve_dense(const LinearElements& elements, const BoundaryElementOptions& options) {
    DenseEquations equations = dense_equations(elements, options);
    BoundaryElementResult result;
    result.tensor = single_layer_energies(equations.rotations, equations.translation_energies) +
                    equations.loads.transpose() * solved(equations);
    result.memory = equations.memory;
    result.closure_error = equations.rotations.closure_error;
    result.unknowns = elements.node_count();
    return result;
}

/// Returns <n_k, S n_l> by the compressed matrix.
Matrix3d translation_energies(const LinearElements& elements, const CompressedMatrix& single_layer,
                              int threads) {
    const auto normals = normals_of(elements);
    CurlColumns columns = CurlColumns::Zero(normals.rows(), 18);
    columns.leftCols<3>() = normals.cast<float>();
    const CurlColumns products = single_layer.times(columns, threads);
    return normals.transpose() * products.leftCols<3>().cast<double>();
}

Eigen::Matrix<double, Eigen::Dynamic, 3> coordinate_loads(const LinearElements& elements,
                                                          const CompressedMatrix& single_layer, int threads) {
    SixColumns columns = SixColumns::Zero(eigen_index(elements.node_count()), 6);
    columns.leftCols<3>() = coordinates_of(elements);
    return hypersingular_times(elements, single_layer, columns, threads).leftCols<3>();
}

BoundaryElementResult solve_compressed(const LinearElements& elements, const BoundaryElementOptions& options,
                                       const HypersingularOptions& how) {
    const SingleLayerEntries entries(elements.triangles);
    const CompressedMatrix single_layer(entries, elements.tree, how.compression, options.threads,
                                        part_of(options.progress, 0.0, 0.3));
    const RotationLoads rotations =
        rotation_loads(elements, options.threads, part_of(options.progress, 0.3, 0.7));
    const SchwarzPreconditioner preconditioner(
        elements, [&](const std::vector<std::size_t>& triangles) { return single_layer.part(triangles); },
        schwarz_cluster, options.threads);
    const SixColumns loads =
        all_loads(elements, rotations, coordinate_loads(elements, single_layer, options.threads));
    BoundaryElementResult result;
    result.tensor =
        single_layer_energies(rotations, translation_energies(elements, single_layer, options.threads));
    const auto solution = conjugate_gradients(
        [&](const SixColumns& columns) {
            return hypersingular_times(elements, single_layer, columns, options.threads);
        },
        [&](const SixColumns& columns) { return preconditioner.apply(columns, options.threads); }, loads,
        result.tensor.diagonal(), how.tolerance, part_of(options.progress, 0.75, 1.0));
    if (!solution) throw Error(unsolvable);
    result.tensor += solution->energies;
    result.closure_error = rotations.closure_error;
    result.unknowns = elements.node_count();
    result.iterations = solution->iterations;
    result.memory = single_layer.memory() + preconditioner.memory();
    return result;
}

}  // namespace

RowMatrix dense_single_layer(const SingleLayerEntries& entries, int threads,
                             const std::function<void(double)>& progress) {
    const std::size_t count = entries.size();
    RowMatrix matrix(eigen_index(count), eigen_index(count));
    const std::size_t pieces = (count + rows_a_piece - 1) / rows_a_piece;
    // Rows from the top and from the bottom alternately: pieces of about equal work.
    parallel_for(
        pieces, 1, threads,
        [&](std::size_t begin, std::size_t) {
            const std::size_t piece = begin % 2 == 0 ? begin / 2 : pieces - 1 - begin / 2;
            const std::size_t end = std::min((piece + 1) * rows_a_piece, count);
            for (std::size_t i = piece * rows_a_piece; i < end; ++i) {
                entries.fill_row(i, i, count, &matrix(eigen_index(i), eigen_index(i)));
            }
        },
        progress);
    parallel_for(pieces, 1, threads, [&](std::size_t piece, std::size_t) {
        const Eigen::Index begin = eigen_index(piece * rows_a_piece);
        const Eigen::Index rows = std::min(eigen_index(rows_a_piece), eigen_index(count) - begin);
        matrix.block(begin, 0, rows, begin) = matrix.block(0, begin, begin, rows).transpose();
        for (Eigen::Index i = begin; i < begin + rows; ++i) {
            for (Eigen::Index j = begin; j < i; ++j) matrix(i, j) = matrix(j, i);
        }
    });
    return matrix;
}

RowMatrix dense_hypersingular(const LinearElements& elements, const RowMatrix& single_layer, int threads) {
    const auto corners = corners_of_nodes(elements);
    std::vector<std::array<Vector3d, 3>> curls(elements.triangle_count());
    for (std::size_t t = 0; t < curls.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) curls[t][k] = elements.curl(t, k);
    }
    RowMatrix matrix = RowMatrix::Zero(eigen_index(corners.size()), eigen_index(corners.size()));
    parallel_for(corners.size(), rows_a_piece, threads, [&](std::size_t begin, std::size_t end) {
        Eigen::Matrix<double, 3, Eigen::Dynamic> row(3, eigen_index(curls.size()));
        for (std::size_t i = begin; i < end; ++i) {
            row.setZero();
            for (const auto& [t, k] : corners[i]) row += curls[t][k] * single_layer.row(eigen_index(t));
            for (std::size_t t = 0; t < curls.size(); ++t) {
                for (std::size_t k = 0; k < 3; ++k) {
                    matrix(eigen_index(i), eigen_index(elements.node(t, k))) +=
                        row.col(eigen_index(t)).dot(curls[t][k]);
                }
            }
        }
    });
    return matrix;
}

BoundaryElementResult solve_hypersingular(const Surface& surface, const BoundaryElementOptions& options,
                                          const HypersingularOptions& how) {
    const LinearElements elements = linear_elements(surface, leaf_size);
    return elements.node_count() <= how.most_dense_nodes ? solve_dense(elements, options)
                                                         : solve_compressed(elements, options, how);
}

SixColumns unit_potentials(const Surface& surface, int threads) {
    const LinearElements elements = linear_elements(surface, leaf_size);
    DenseEquations equations = dense_equations(elements, {threads, {}});
    const SixColumns of_nodes = solved(equations);
    SixColumns potentials = SixColumns::Zero(eigen_index(surface.vertices.size()), 6);
    for (std::size_t t = 0; t < elements.triangle_count(); ++t) {
        const auto& corners = surface.corners[elements.tree.order[t]];
        for (std::size_t k = 0; k < 3; ++k) {
            potentials.row(corners[k]) = -of_nodes.row(eigen_index(elements.node(t, k)));
        }
    }
    return potentials;
}

}  // namespace samara
