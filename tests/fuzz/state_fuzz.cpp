// The bytes of samara_set_state: raw, or a sound state with numbers overwritten and its seal renewed, which
// no accident makes.

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "harness.hpp"
#include "samara.h"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/folders.hpp"
#include "samara/core/simulation/state_bytes.hpp"
#include "support/known_bodies.hpp"

namespace samara::fuzz {
namespace {

constexpr std::size_t hash_size = 32;

/// Two kinds of bodies, one on the ground, in the middle of a step.
class Simulation {
  public:
    Simulation() {
        Body body = test::rubber_ellipsoid();
        body.name = "rubber";
        body.source = "invented";
        body.tables = test::blunt_tables(body, 2);
        const TemporaryFolder folder;
        write_body_file(folder / "rubber.body.h5", body);
        samara_body* loaded = nullptr;
        succeed(samara_body_load((folder / "rubber.body.h5").c_str(), &loaded, nullptr, 0));
        samara_settings settings;
        succeed(samara_default_settings(&settings, sizeof settings, nullptr, 0));
        settings.has_ground = 1;
        settings.ground = -0.05;
        succeed(samara_simulation_create(&settings, &simulation_, nullptr, 0));
        samara_body_group kind;
        succeed(samara_default_body_group(&kind, sizeof kind, nullptr, 0));
        kind.density = 1200.0;
        kind.count = 2;
        kind.name = "falling";
        kind.position[2] = 1.0;
        succeed(samara_simulation_add(simulation_, loaded, &kind, nullptr, nullptr, 0));
        kind.name = "landing";
        kind.loads = SAMARA_LOADS_COEFFICIENTS;
        kind.position[2] = 0.0;
        kind.start = 0.005;
        succeed(samara_simulation_add(simulation_, loaded, &kind, nullptr, nullptr, 0));
        samara_body_free(loaded);
        succeed(samara_advance_to(simulation_, 0.0131, nullptr, 0));
        state_ = state();
    }
    ~Simulation() { samara_simulation_free(simulation_); }
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    [[nodiscard]] const std::string& sound_state() const { return state_; }

    [[nodiscard]] std::string state() const {
        std::string bytes(samara_state_size(simulation_), '\0');
        succeed(samara_get_state(simulation_, bytes.data(), bytes.size(), nullptr, 0));
        return bytes;
    }

    /// Sets the simulation to the bytes, flies on a little where it takes them, and puts it back.
    void try_state(std::string_view bytes) {
        const samara_status status = samara_set_state(simulation_, bytes.data(), bytes.size(), nullptr, 0);
        if (status == SAMARA_OK) {
            require_finite_poses();
            const double time = samara_simulation_time(simulation_);
            for (const double later : {0.0, 0.001, 0.01}) {
                const samara_status flown = samara_advance_to(simulation_, time + later, nullptr, 0);
                require(flown != SAMARA_INTERNAL_ERROR, "advancing from a state has no internal error");
                if (flown == SAMARA_OK) require_finite_poses();
            }
        } else {
            require(status == SAMARA_FOREIGN_STATE, "what is no state is a foreign state");
            require(state() == state_, "a state that is refused changes nothing");
        }
        succeed(samara_set_state(simulation_, state_.data(), state_.size(), nullptr, 0));
        require(state() == state_, "a sound state brings all of it back");
    }

  private:
    static void succeed(samara_status status) { require(status == SAMARA_OK, "sound calls succeed"); }

    void require_finite_poses() const {
        std::vector<samara_pose> poses(samara_simulation_count(simulation_));
        if (samara_get_poses(simulation_, 0, poses.size(), poses.data(), 0, nullptr, 0) != SAMARA_OK) return;
        std::vector<double> numbers(poses.size() * sizeof(samara_pose) / sizeof(double));
        std::memcpy(numbers.data(), poses.data(), poses.size() * sizeof(samara_pose));
        for (const double number : numbers) require(std::isfinite(number), "poses are finite numbers");
    }

    samara_simulation* simulation_ = nullptr;
    std::string state_;
};

/// A sound state with eight bytes overwritten for every ten of the input: where in the payload, and with
/// what.
std::string overwritten(std::string bytes, std::string_view edits) {
    const std::size_t begin = seal_size() - hash_size;
    const std::size_t end = bytes.size() - hash_size;
    for (; edits.size() >= 10; edits.remove_prefix(10)) {
        std::uint16_t place = 0;
        std::memcpy(&place, edits.data(), sizeof place);
        std::memcpy(bytes.data() + begin + place % (end - begin - 7), edits.data() + 2, 8);
    }
    bytes.resize(end);
    return bytes += content_hash(bytes);
}

}  // namespace

/// The first byte: 'r' for raw bytes, else edits of a sound state.
void feed(std::string_view input) {
    static Simulation simulation;
    if (input.empty()) return;
    const std::string_view rest = input.substr(1);
    simulation.try_state(input.front() == 'r' ? std::string(rest)
                                              : overwritten(simulation.sound_state(), rest));
}

}  // namespace samara::fuzz
