#include "samara/commands/option_values.hpp"

#include <fmt/format.h>

#include "samara/core/base/error.hpp"

namespace samara {

const BodyMotion& find_body(const std::string& input, const Motion& motion, const std::string& name) {
    if (name.empty()) return motion.bodies.front();
    std::string names;
    for (const BodyMotion& body : motion.bodies) {
        if (body.name == name) return body;
        names += (names.empty() ? "" : ", ") + body.name;
    }
    throw Error(fmt::format("{}: holds no body '{}'; it holds: {}", input, name, names));
}

void require_run(const std::string& input, const Motion& motion, int run) {
    if (run < motion.runs) return;
    throw Error(motion.runs == 1 ? fmt::format("{}: holds only run 0, not run {}; give run 0", input, run)
                                 : fmt::format("{}: holds runs 0 to {}, not run {}; give one of these", input,
                                               motion.runs - 1, run));
}

void require_copy(const std::string& input, const BodyMotion& body, int copy) {
    if (copy < body.copies) return;
    throw Error(
        body.copies == 1
            ? fmt::format("{}: holds only copy 0 of {}, not copy {}; give copy 0", input, body.name, copy)
            : fmt::format("{}: holds copies 0 to {} of {}, not copy {}; give one of these", input,
                          body.copies - 1, body.name, copy));
}

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
