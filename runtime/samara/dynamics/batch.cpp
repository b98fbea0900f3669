#include "samara/dynamics/batch.hpp"

#include <algorithm>
#include <mutex>

#include "samara/base/parallel_for.hpp"
#include "samara/dynamics/kernel/kernel.hpp"

namespace samara {
namespace {

constexpr std::size_t blocks_a_piece = 64;

}  // namespace

template <class Real>
BasicBatch<Real>::BasicBatch(const ImmersedBody& body, std::size_t count)
    : body_(&body),
      size_(count),
      constants_(flight_constants<Real>(body)),
      blocks_((count + FlightBlock<Real>::size - 1) / FlightBlock<Real>::size) {
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
        blocks_[i].bodies = std::min(FlightBlock<Real>::size, count - i * FlightBlock<Real>::size);
        for (std::size_t lane = 0; lane < FlightBlock<Real>::size; ++lane) {
            keep_state(BodyState{}, blocks_[i], lane);
        }
    }
    for (std::size_t i = 0; i < count; ++i) set_noise(i, Noise(0, "", 0, 0));
}

template <class Real>
void BasicBatch<Real>::set_state(std::size_t index, const BodyState& state) noexcept {
    keep_state(state, blocks_[index / FlightBlock<Real>::size], index % FlightBlock<Real>::size);
}

template <class Real>
BodyState BasicBatch<Real>::state(std::size_t index) const noexcept {
    return state_of(blocks_[index / FlightBlock<Real>::size], index % FlightBlock<Real>::size);
}

template <class Real>
void BasicBatch<Real>::set_noise(std::size_t index, const Noise& noise) noexcept {
    const auto words = noise.words();
    FlightBlock<Real>& block = blocks_[index / FlightBlock<Real>::size];
    for (std::size_t word = 0; word < words.size(); ++word) {
        block.noise[word][index % FlightBlock<Real>::size] = words[word];
    }
}

template <class Real>
BatchReport BasicBatch<Real>::advance(const Surroundings& surroundings, double time, double time_step,
                                      std::uint64_t first_step, std::uint64_t steps, int threads) {
    std::vector<Vector3d> gravities;
    for (std::uint64_t step = 0; step < steps; ++step) {
        const double begin = time + static_cast<double>(step) * time_step;
        gravities.push_back(apparent_gravity(surroundings, begin, begin + time_step));
    }
    const kernel::BlockSteps task{.gravities = gravities.data(),
                                  .time = time,
                                  .time_step = time_step,
                                  .first_step = first_step,
                                  .steps = steps};
    BatchReport report;
    std::mutex mutex;
    parallel_for(blocks_.size(), blocks_a_piece, threads, [&](std::size_t begin, std::size_t end) {
        const kernel::BlockReport piece =
            kernel::advance_blocks(constants_, task, &blocks_[begin], end - begin);
        const std::lock_guard lock(mutex);
        report.implicit_steps += piece.implicit_steps;
        report.most_substeps = std::max(report.most_substeps, piece.most_substeps);
    });
    return report;
}

template class BasicBatch<float>;
template class BasicBatch<double>;

}  // namespace samara
