#include "samara/core/files/row_major.hpp"

namespace samara {

std::vector<double> flattened(const std::vector<Vector3d>& vectors) {
    std::vector<double> values;
    values.reserve(3 * vectors.size());
    for (const Vector3d& vector : vectors) values.insert(values.end(), vector.data(), vector.data() + 3);
    return values;
}

std::vector<Vector3d> unflattened(const std::vector<double>& values) {
    std::vector<Vector3d> vectors(values.size() / 3);
    for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] = Vector3d(values.data() + 3 * i);
    return vectors;
}

}  // namespace samara
