#include "samara/dynamics/batch.hpp"

#include <algorithm>
#include <mutex>

#include "samara/base/parallel_for.hpp"

namespace samara {
namespace {

constexpr std::size_t bodies_a_piece = 64;

}  // namespace

Batch::Batch(const ImmersedBody& body, std::size_t count)
    : body_(&body), states_(count), noises_(count, Noise(0, "", 0, 0)) {}

void Batch::set_state(std::size_t index, const BodyState& state) noexcept {
    states_[index] = state;
}

BodyState Batch::state(std::size_t index) const noexcept {
    return states_[index];
}

void Batch::set_noise(std::size_t index, const Noise& noise) noexcept {
    noises_[index] = noise;
}

BatchReport Batch::advance(const Surroundings& surroundings, double time, double time_step,
                           std::uint64_t first_step, std::uint64_t steps, int threads) {
    BatchReport report;
    std::mutex mutex;
    parallel_for(states_.size(), bodies_a_piece, threads, [&](std::size_t begin, std::size_t end) {
        BatchReport piece;
        for (std::size_t i = begin; i < end; ++i) {
            for (std::uint64_t step = 0; step < steps; ++step) {
                const StepResult result =
                    samara::advance(*body_, surroundings, time + static_cast<double>(step) * time_step,
                                    time_step, states_[i], noises_[i], first_step + step);
                states_[i] = result.state;
                piece.implicit_steps += static_cast<std::uint64_t>(result.substeps);
                piece.most_substeps = std::max(piece.most_substeps, result.substeps);
                piece.steps_at_limit += result.substeps == most_substeps ? 1 : 0;
            }
        }
        const std::lock_guard lock(mutex);
        report.implicit_steps += piece.implicit_steps;
        report.most_substeps = std::max(report.most_substeps, piece.most_substeps);
        report.steps_at_limit += piece.steps_at_limit;
    });
    return report;
}

}  // namespace samara
