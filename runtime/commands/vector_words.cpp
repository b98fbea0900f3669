#include "samara/commands/vector_words.hpp"

namespace samara {

std::optional<Vector3d> vector_of_words(const std::string& words) {
    Vector3d vector;
    int end = 0;
    const int found =
        std::sscanf(words.c_str(), "%lf,%lf,%lf%n", &vector.x(), &vector.y(), &vector.z(), &end);
    if (found != 3 || static_cast<std::size_t>(end) != words.size() || !vector.allFinite())
        return std::nullopt;
    return vector;
}

}  // namespace samara
