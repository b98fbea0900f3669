#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/integrator/step.hpp"
#include "samara/core/kernel/kernel.hpp"
#include "samara/core/kernel/noise.hpp"
#include "samara/core/kernel/state_block.hpp"
#include "samara/core/physics/contact_record.hpp"
#include "samara/core/physics/precision.hpp"
#include "samara/core/physics/wrench.hpp"

namespace samara {

/// Bodies of one group that are stepped together, as many at a time as the machine's vectors hold. Each moves
/// the same, to the last bit, whatever its place in the batch, the number of threads and the division of the
/// steps into calls; in double precision as advance() moves it alone.
class Batch {
  public:
    /// Makes `count` bodies at rest at the origin. `body` must outlive the batch.
    Batch(const ImmersedBody& body, std::size_t count, Precision precision = Precision::double_precision);

    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    /// Takes the body with contact points, equal otherwise; it must outlive the batch.
    void set_body(const ImmersedBody& body) noexcept { body_ = &body; }
    void set_state(std::size_t index, const BodyState& state) noexcept;
    [[nodiscard]] BodyState state(std::size_t index) const noexcept;
    /// Makes body number i `sizes[i]` (above zero) times as large as the shape, at its density: before its
    /// state is set. `touch`: whether they may touch ground or obstacles.
    void set_sizes(std::vector<double> sizes, bool touch);
    /// Returns the sizes that were set; empty where all are the shape's.
    [[nodiscard]] const std::vector<double>& sizes() const noexcept { return sizes_; }
    /// Makes the body wait in its place until this step begins.
    void set_first_step(std::size_t index, std::uint64_t step) noexcept;
    /// Returns the state in the units that the steps are taken in: keep_own_state() takes it, to the last
    /// bit.
    [[nodiscard]] BodyState own_state(std::size_t index) const noexcept;
    void keep_own_state(std::size_t index, const BodyState& state) noexcept;
    /// Returns the number of the first body whose place or velocity is not finite; size() where all are.
    [[nodiscard]] std::size_t first_not_finite() const noexcept;
    /// Returns the body's size relative to the shape's; 1 where none was set.
    [[nodiscard]] double size_of(std::size_t index) const noexcept {
        return sizes_.empty() ? 1.0 : sizes_[index];
    }
    /// Returns the touching body of body number `index`.
    [[nodiscard]] const TouchingBody& touching(std::size_t index) const noexcept {
        return touching_.empty() ? static_cast<const TouchingBody&>(*body_) : touching_[index];
    }
    /// Sets the source of the body's random numbers; by default that of seed 0, no name, run 0 and copy 0.
    void set_noise(std::size_t index, const Noise& noise) noexcept;

    /// Applies `external[i]` to body number i in all steps from now on; none where it is empty.
    void set_external(const std::vector<Wrench>& external);
    /// Records the contacts of bodies with ground and obstacles from now on, or no longer.
    void watch_contacts(bool watch) { records_.assign(watch ? size_ : 0, {}); }
    /// Returns whether contacts are recorded.
    [[nodiscard]] bool watches_contacts() const noexcept { return !records_.empty(); }
    /// Returns the record of a body's contacts; null: not recorded.
    [[nodiscard]] ContactRecord* record(std::size_t index) noexcept {
        return records_.empty() ? nullptr : &records_[index];
    }
    /// Leaves a body's contacts to the caller, or not.
    void leave_contact(std::size_t index, bool leave) {
        if (contact_left_.empty() && !leave) return;
        contact_left_.resize(size_);
        contact_left_[index] = leave ? 1 : 0;
    }
    [[nodiscard]] bool is_contact_left(std::size_t index) const noexcept {
        return !contact_left_.empty() && contact_left_[index] != 0;
    }
    /// Returns a body's contacts since they were last taken. Needs watches_contacts().
    ContactRecord take_contacts(std::size_t index) noexcept { return std::exchange(records_[index], {}); }

    /// Takes `steps` steps of `time_step` (s) each; the first is the bodies' step number `first_step`; their
    /// simulation began at `start` (s, of the world). `threads`: 0 for all cores.
    BatchReport advance(const Surroundings& surroundings, double start, double time_step,
                        std::uint64_t first_step, std::uint64_t steps, int threads = 1);

  private:
    const ImmersedBody* body_;
    std::size_t size_;
    StepConstants constants_;
    std::optional<StepConstantsIn<float>> in_single_;  ///< in single precision
    std::vector<StateBlock> blocks_;
    std::vector<double> sizes_;                    ///< empty where all are the shape's
    std::vector<TouchingBody> touching_;           ///< of each size, where there is something to touch
    std::vector<Vector3d> gravities_;              ///< of the steps of a call
    std::vector<kernel::ExternalLoads> external_;  ///< of each block; empty where nothing acts
    std::vector<ContactRecord> records_;           ///< of each body; empty where not recorded
    std::vector<std::uint8_t>
        contact_left_;  ///< of each body 1 or 0; empty where the batch handles all contacts
};

}  // namespace samara
