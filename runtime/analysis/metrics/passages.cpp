#include "samara/analysis/metrics/passages.hpp"

namespace samara {

std::vector<Passage> passages_of(const FallSeries& record, const std::vector<double>& depths) {
    std::vector<Passage> passages;
    double before = 0.0;
    for (std::size_t i = 1; i < record.displacements.size(); ++i) {
        const double after = record.displacements[i].dot(record.down);
        while (passages.size() < depths.size() && depths[passages.size()] <= after) {
            const double share = (depths[passages.size()] - before) / (after - before);
            const Vector3d displacement =
                record.displacements[i - 1] + share * (record.displacements[i] - record.displacements[i - 1]);
            passages.push_back({record.times[i - 1] + share * (record.times[i] - record.times[i - 1]),
                                displacement - displacement.dot(record.down) * record.down});
        }
        before = after;
    }
    return passages;
}

}  // namespace samara
