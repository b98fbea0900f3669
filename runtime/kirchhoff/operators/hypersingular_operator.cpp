#include "samara/kirchhoff/operators/hypersingular_operator.hpp"

namespace samara {
namespace {

Eigen::Index at(std::size_t index) {
    return static_cast<Eigen::Index>(index);
}

}  // namespace

SixColumns hypersingular_times(const LinearElements& elements, const CompressedMatrix& single_layer,
                               const SixColumns& columns, int threads) {
    CurlColumns curls(at(elements.triangle_count()), 18);
    for (std::size_t t = 0; t < elements.triangle_count(); ++t) {
        Eigen::Matrix<double, 3, 6> sum = Eigen::Matrix<double, 3, 6>::Zero();
        for (std::size_t k = 0; k < 3; ++k) {
            sum += elements.curl(t, k) * columns.row(at(elements.node(t, k)));
        }
        for (Eigen::Index c = 0; c < 18; ++c) curls(at(t), c) = static_cast<float>(sum(c / 6, c % 6));
    }
    const CurlColumns products = single_layer.times(curls, threads);
    SixColumns result = SixColumns::Zero(at(elements.node_count()), 6);
    for (std::size_t t = 0; t < elements.triangle_count(); ++t) {
        Eigen::Matrix<double, 3, 6> product;
        for (Eigen::Index c = 0; c < 18; ++c) product(c / 6, c % 6) = static_cast<double>(products(at(t), c));
        for (std::size_t k = 0; k < 3; ++k) {
            result.row(at(elements.node(t, k))) += elements.curl(t, k).transpose() * product;
        }
    }
    return result;
}

}  // namespace samara
