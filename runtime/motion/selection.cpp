#include "samara/motion/selection.hpp"

#include <algorithm>
#include <cstddef>

namespace samara {
namespace {

/// Returns the values of the copies in the range, of an array whose last index is the copy.
template <typename Value>
std::vector<Value> of_copies(const std::vector<Value>& values, int copies, const CopyRange& range) {
    std::vector<Value> kept;
    kept.reserve(values.size() / static_cast<std::size_t>(copies) *
                 static_cast<std::size_t>(range.last - range.first + 1));
    for (auto row = values.begin(); row != values.end(); row += copies) {
        kept.insert(kept.end(), row + range.first, row + range.last + 1);
    }
    return kept;
}

}  // namespace

Motion selected(Motion motion, const std::vector<std::string>& names,
                const std::optional<CopyRange>& copies) {
    const auto is_left_out = [&](const auto& named) {
        return !names.empty() && std::find(names.begin(), names.end(), named.name) == names.end();
    };
    std::erase_if(motion.bodies, is_left_out);
    std::erase_if(motion.obstacles, is_left_out);
    if (!copies) return motion;
    for (BodyMotion& body : motion.bodies) {
        body.poses = of_copies(body.poses, body.copies, *copies);
        body.forces = of_copies(body.forces, body.copies, *copies);
        body.sizes = of_copies(body.sizes, body.copies, *copies);
        body.copies = copies->last - copies->first + 1;
    }
    return motion;
}

}  // namespace samara
