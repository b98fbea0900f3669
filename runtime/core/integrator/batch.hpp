#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/integrator/step.hpp"
#include "samara/core/kernel/kernel.hpp"
#include "samara/core/kernel/noise.hpp"
#include "samara/core/kernel/state_block.hpp"
#include "samara/core/physics/contact_record.hpp"
#include "samara/core/physics/wrench.hpp"

namespace samara {

/// Many bodies of one kind that are stepped together, as many at a time as the machine's vectors hold. Each
/// moves as advance() moves it alone, whatever its place in the batch, the number of threads and the way the
/// steps are cut into calls, to the last bit.
class Batch {
  public:
    /// `body` must outlive the batch. All start at rest at the origin.
    Batch(const ImmersedBody& body, std::size_t count);

    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    void set_state(std::size_t index, const BodyState& state) noexcept;
    [[nodiscard]] BodyState state(std::size_t index) const noexcept;
    /// Makes body number i `sizes[i]` (above zero) times as large as the shape, at its density: before its
    /// state is set. `touch`: whether they meet ground or obstacles.
    void set_sizes(std::vector<double> sizes, bool touch);
    /// What was set; none where all are the shape's.
    [[nodiscard]] const std::vector<double>& sizes() const noexcept { return sizes_; }
    /// The body waits where it is until this step begins.
    void set_first_step(std::size_t index, std::uint64_t step) noexcept;
    /// The state in the numbers that the steps are taken with: what keep_own_state() takes, to the last bit.
    [[nodiscard]] BodyState own_state(std::size_t index) const noexcept;
    void keep_own_state(std::size_t index, const BodyState& state) noexcept;
    /// Over the shape's; 1 where none was set.
    [[nodiscard]] double size_of(std::size_t index) const noexcept {
        return sizes_.empty() ? 1.0 : sizes_[index];
    }
    /// What body number `index` touches with.
    [[nodiscard]] const TouchingBody& touching(std::size_t index) const noexcept {
        return touching_.empty() ? static_cast<const TouchingBody&>(*body_) : touching_[index];
    }
    /// The source of the body's random numbers; without it, that of seed 0, no name, run 0 and copy 0.
    void set_noise(std::size_t index, const Noise& noise) noexcept;

    /// Pushes body number i over all steps from now on by `external[i]`; none are pushed where it is empty.
    void set_external(const std::vector<Wrench>& external);
    /// Whether what bodies meet of ground and obstacles is noted from now on.
    void watch_contacts(bool watch) { met_.assign(watch ? size_ : 0, {}); }
    /// Whether it is.
    [[nodiscard]] bool watches_contacts() const noexcept { return !met_.empty(); }
    /// Where what a body meets is noted; null: nowhere.
    [[nodiscard]] ContactRecord* record(std::size_t index) noexcept {
        return met_.empty() ? nullptr : &met_[index];
    }
    /// Leaves it to the caller what a body touches, or not.
    void leave_contact(std::size_t index, bool leave) {
        if (left_.empty() && !leave) return;
        left_.resize(size_);
        left_[index] = leave ? 1 : 0;
    }
    [[nodiscard]] bool is_contact_left(std::size_t index) const noexcept {
        return !left_.empty() && left_[index] != 0;
    }
    /// What a body met since it was last asked. Needs watches_contacts().
    ContactRecord take_contacts(std::size_t index) noexcept { return std::exchange(met_[index], {}); }

    /// `steps` steps of `time_step` (s) each; the first is the bodies' step number `first_step`; their
    /// flight began at `start` (s, of the world). `threads`: 0 for all cores.
    BatchReport advance(const Surroundings& surroundings, double start, double time_step,
                        std::uint64_t first_step, std::uint64_t steps, int threads = 1);

  private:
    const ImmersedBody* body_;
    std::size_t size_;
    StepConstants constants_;
    std::vector<StateBlock> blocks_;
    std::vector<double> sizes_;                    ///< none where all are the shape's
    std::vector<TouchingBody> touching_;           ///< of each size, where there is something to touch
    std::vector<kernel::ExternalLoads> external_;  ///< of each block; none where nothing is pushed
    std::vector<ContactRecord> met_;               ///< of each body; none where it is not noted
    std::vector<std::uint8_t> left_;  ///< of each body 1 or 0; none where all touch by themselves
};

}  // namespace samara
