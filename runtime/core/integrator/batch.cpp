#include "samara/core/integrator/batch.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <mutex>
#include <utility>

#include "samara/core/base/parallel_for.hpp"
#include "samara/core/contact/ground_contact.hpp"
#include "samara/core/dynamics/body_size.hpp"
#include "samara/core/dynamics/body_wind.hpp"
#include "samara/core/kernel/kernel.hpp"

namespace samara {
namespace {

constexpr std::size_t blocks_a_piece = 64;

/// The ground of the bodies of a batch.
struct BatchGround {
    const Batch& batch;
    const ImmersedBody& body;
    double largest;  ///< the largest size
    const Surroundings& surroundings;
    ContactRecord* records;  ///< of each body; null: not recorded

    static void resolve(const void* context, std::size_t index, double time, double substep,
                        const BodyState& before, BodyState& state) noexcept {
        const auto& ground = *static_cast<const BatchGround*>(context);
        if (ground.batch.is_contact_left(index)) return;
        const Ground now = ground_in_flow(ground.surroundings, time - substep, time);
        const double size = ground.batch.size_of(index);
        ContactRecord* record = ground.records == nullptr ? nullptr : ground.records + index;
        if (size == 1.0)
            return touch_ground(ground.batch.touching(index), now, substep, before, state, record);
        const BodyState world_before = in_world_units(before, size);
        BodyState world = in_world_units(state, size);
        touch_ground(ground.batch.touching(index), now, substep, world_before, world, record);
        state = in_own_units(world, size);
        // A body at rest keeps its place to the last bit.
        if (world.position == world_before.position) state.position = before.position;
    }

    static void stay(const void* context, std::size_t index, double begin, double end,
                     BodyState& state) noexcept {
        const auto& ground = *static_cast<const BatchGround*>(context);
        const Ground now = ground_in_flow(ground.surroundings, begin, end);
        const double size = ground.batch.size_of(index);
        if (size == 1.0) return keep_on_ground(now, state);
        BodyState world = in_world_units(state, size);
        keep_on_ground(now, world);
        state = in_own_units(world, size);
    }

    [[nodiscard]] kernel::Contact contact(double start, double time_step, std::uint64_t first_step,
                                          std::uint64_t steps) const noexcept {
        if (!has_ground(surroundings)) return {};
        const double radius = largest * body.contact_points.bounding_radius;
        const double fastest = surroundings.current.norm() + surroundings.gust.amplitude.norm();
        const ObstacleSet* obstacles = surroundings.obstacles.get();
        double highest = -std::numeric_limits<double>::infinity();
        Eigen::AlignedBox3d box;
        for (std::uint64_t step = first_step; step <= first_step + steps; ++step) {
            const double time = step_time(start, time_step, step);
            const Vector3d displacement = flow_displacement(surroundings, time);
            if (surroundings.ground) highest = std::max(highest, *surroundings.ground - displacement.z());
            if (obstacles != nullptr) box.extend(obstacles->whereabouts().translated(-displacement));
        }
        const Vector3d between_steps = Vector3d::Constant(fastest * time_step);
        return {.resolve = resolve,
                .stay = stay,
                .judgement = judgement_of_rest(body, surroundings, time_step),
                .moves = fastest > 0.0,
                .context = this,
                .reach = highest + radius + fastest * time_step,
                .radius = radius,
                .ground_speed = fastest,
                .has_obstacles = obstacles != nullptr,
                .box_low = box.min() - between_steps,
                .box_high = box.max() + between_steps};
    }
};

Wrench wrench_of(const kernel::ExternalLoads& external, std::size_t lane) noexcept {
    Wrench wrench;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        wrench.force[static_cast<Eigen::Index>(axis)] = external.force[axis][lane];
        wrench.moment[static_cast<Eigen::Index>(axis)] = external.moment[axis][lane];
    }
    return wrench;
}

/// Steps one body alone: to the same bits as in a vector of bodies, and faster.
BatchReport advance_alone(const ImmersedBody& body, const Surroundings& surroundings,
                          const kernel::BlockSteps& task, ContactRecord* record, StateBlock& block) noexcept {
    const Noise noise(std::array{block.noise[0][0], block.noise[1][0], block.noise[2][0], block.noise[3][0]});
    BatchReport report;
    BodyState state = state_of(block, 0);
    Wrench external;
    if (task.external != nullptr) external = wrench_of(*task.external, 0);
    const Wrench* pushed = task.external == nullptr ? nullptr : &external;
    if (task.contact.resolve == nullptr) {
        kernel::BlockSteps rest = task;
        const std::uint64_t end = task.first_step + task.steps;
        rest.first_step = std::min(end, std::max(task.first_step, block.first_step[0]));
        rest.gravities += rest.first_step - task.first_step;
        rest.steps = end - rest.first_step;
        report = kernel::advance_one(body.constants, rest, noise, pushed, state);
        keep_state(state, block, 0);
        return report;
    }
    for (std::uint64_t step = std::max(task.first_step, block.first_step[0]);
         step < task.first_step + task.steps; ++step) {
        const StepResult result =
            advance(body, surroundings, task.start, task.time_step, state, noise, step, pushed, record);
        state = result.state;
        report.count(result.substeps);
        report.wind_is_sound = report.wind_is_sound && result.wind_is_sound;
    }
    keep_state(state, block, 0);
    return report;
}

}  // namespace

Batch::Batch(const ImmersedBody& body, std::size_t count, Precision precision)
    : body_(&body),
      size_(count),
      constants_(step_constants(body)),
      blocks_((count + StateBlock::size - 1) / StateBlock::size) {
    if (precision == Precision::single_precision) in_single_ = in_single(constants_);
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
        blocks_[i].bodies = std::min(StateBlock::size, count - i * StateBlock::size);
        for (std::size_t lane = 0; lane < StateBlock::size; ++lane) {
            keep_state(BodyState{}, blocks_[i], lane);
            blocks_[i].size_of[lane] = 1.0;
            blocks_[i].first_step[lane] = 0;
        }
        blocks_[i].first_body = i * StateBlock::size;
        blocks_[i].last_start = 0;
    }
    for (std::size_t i = 0; i < count; ++i) set_noise(i, Noise(0, "", 0, 0));
}

void Batch::set_sizes(std::vector<double> sizes, bool touch) {
    sizes_ = std::move(sizes);
    touching_.clear();
    for (std::size_t i = 0; i < size_; ++i) {
        blocks_[i / StateBlock::size].size_of[i % StateBlock::size] = sizes_[i];
        if (touch) touching_.push_back(touching_body(*body_, sizes_[i]));
    }
}

void Batch::set_external(const std::vector<Wrench>& external) {
    external_.assign(external.empty() ? 0 : blocks_.size(), {});
    for (std::size_t i = 0; i < external.size(); ++i) {
        kernel::ExternalLoads& loads = external_[i / kernel::ExternalLoads::size];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t lane = i % kernel::ExternalLoads::size;
            loads.force[axis][lane] = external[i].force[static_cast<Eigen::Index>(axis)];
            loads.moment[axis][lane] = external[i].moment[static_cast<Eigen::Index>(axis)];
        }
    }
}

void Batch::set_first_step(std::size_t index, std::uint64_t step) noexcept {
    StateBlock& block = blocks_[index / StateBlock::size];
    block.first_step[index % StateBlock::size] = step;
    block.last_start = *std::max_element(block.first_step, block.first_step + StateBlock::size);
}

void Batch::set_state(std::size_t index, const BodyState& state) noexcept {
    const double size = size_of(index);
    keep_own_state(index, size == 1.0 ? state : in_own_units(state, size));
}

BodyState Batch::state(std::size_t index) const noexcept {
    const double size = size_of(index);
    return size == 1.0 ? own_state(index) : in_world_units(own_state(index), size);
}

void Batch::keep_own_state(std::size_t index, const BodyState& state) noexcept {
    keep_state(state, blocks_[index / StateBlock::size], index % StateBlock::size);
}

BodyState Batch::own_state(std::size_t index) const noexcept {
    return state_of(blocks_[index / StateBlock::size], index % StateBlock::size);
}

std::size_t Batch::first_not_finite() const noexcept {
    constexpr std::size_t rows_of_place_and_velocity = 13;
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
        std::array<double, StateBlock::size> none = {};  // NaN where a number is not finite
        for (std::size_t row = 0; row < rows_of_place_and_velocity; ++row) {
            for (std::size_t lane = 0; lane < none.size(); ++lane)
                none[lane] += 0.0 * blocks_[i].numbers[row][lane];
        }
        for (std::size_t lane = 0; lane < blocks_[i].bodies; ++lane) {
            if (none[lane] != 0.0) return i * StateBlock::size + lane;
        }
    }
    return size_;
}

void Batch::set_noise(std::size_t index, const Noise& noise) noexcept {
    const auto words = noise.words();
    StateBlock& block = blocks_[index / StateBlock::size];
    for (std::size_t word = 0; word < words.size(); ++word) {
        block.noise[word][index % StateBlock::size] = words[word];
    }
}

BatchReport Batch::advance(const Surroundings& surroundings, double start, double time_step,
                           std::uint64_t first_step, std::uint64_t steps, int threads) {
    gravities_.clear();
    for (std::uint64_t step = first_step; step < first_step + steps; ++step) {
        gravities_.push_back(apparent_gravity(surroundings, step_time(start, time_step, step),
                                              step_time(start, time_step, step + 1)));
    }
    const bool sized = !sizes_.empty();
    const double largest = sized ? *std::max_element(sizes_.begin(), sizes_.end()) : 1.0;
    ContactRecord* records = records_.empty() ? nullptr : records_.data();
    const BatchGround ground{*this, *body_, largest, surroundings, records};
    const BodyWind wind(*body_, surroundings, start, time_step);
    const kernel::BlockSteps task{.gravities = gravities_.data(),
                                  .start = start,
                                  .time_step = time_step,
                                  .first_step = first_step,
                                  .steps = steps,
                                  .sized = sized,
                                  .contact = ground.contact(start, time_step, first_step, steps),
                                  .wind = wind.source(),
                                  .external = external_.empty() ? nullptr : external_.data()};
    if (size_ == 1 && !sized && !in_single_ && !is_contact_left(0)) {
        BatchReport alone = advance_alone(*body_, surroundings, task, records, blocks_.front());
        alone.wind_is_sound = alone.wind_is_sound && wind.is_sound();
        return alone;
    }
    BatchReport report;
    std::mutex mutex;
    parallel_for(blocks_.size(), blocks_a_piece, threads, [&](std::size_t begin, std::size_t end) {
        const BatchReport piece =
            in_single_ ? kernel::advance_blocks(*in_single_, task, &blocks_[begin], end - begin)
                       : kernel::advance_blocks(constants_, task, &blocks_[begin], end - begin);
        const std::lock_guard lock(mutex);
        report.add(piece);
    });
    report.wind_is_sound = wind.is_sound();
    return report;
}

}  // namespace samara
