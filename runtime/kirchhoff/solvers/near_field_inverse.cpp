#include "samara/kirchhoff/solvers/near_field_inverse.hpp"

#include <cmath>
#include <vector>

#include "samara/kirchhoff/panels/panel_kernels.hpp"

namespace samara {

NearFieldInverse::NearFieldInverse(const CurvedEquations& equations, double least_entry) {
    const auto strong_entry = static_cast<float>(least_entry);
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t group = 0; group < equations.groups; ++group) {
        const float* rows = equations.group_rows(group);
        for (std::size_t entry = 0; entry < equations.count * group_size; ++entry) {
            if (!(std::abs(rows[entry]) > strong_entry)) continue;
            const std::size_t row = group * group_size + entry % group_size;
            if (row >= equations.count) continue;
            entries.emplace_back(static_cast<int>(row), static_cast<int>(entry / group_size),
                                 static_cast<double>(rows[entry]));
        }
    }
    const auto size = static_cast<int>(equations.count);
    for (int row = 0; row < size; ++row) entries.emplace_back(row, row, equations.diagonal[row]);
    Eigen::SparseMatrix<double> strong(size, size);
    strong.setFromTriplets(entries.begin(), entries.end());
    factors_.compute(strong);
}

SixColumns NearFieldInverse::operator*(const SixColumns& columns) const {
    if (factors_.info() != Eigen::Success) return columns;
    const Eigen::MatrixXd result = factors_.solve(Eigen::MatrixXd(columns));
    return result;
}

}  // namespace samara
