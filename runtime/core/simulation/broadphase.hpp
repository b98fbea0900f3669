#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "samara/core/contact/ground_contact.hpp"
#include "samara/core/contact/island.hpp"
#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/simulation/body_group.hpp"

namespace samara {

/// Takes the steps of bodies that touch each other, all groups together; bodies of different runs never
/// touch. A step depends on the bodies' states before it alone, not on threads or earlier steps.
///
/// Bodies that may touch within a step form an island: they move alone as if there were neither ground nor
/// obstacles, and IslandStep corrects that motion for these and for each other. All other bodies are stepped
/// as usual.
class Broadphase {
  public:
    explicit Broadphase(double step = 0.0, int runs = 0, int threads = 1);

    /// Takes the simulation's step number `number` for all groups that have begun by then. Throws as
    /// BodyGroup::keep_steps() does.
    void take_step(const std::vector<std::unique_ptr<BodyGroup>>& groups, const Surroundings& surroundings,
                   std::uint64_t number);

  private:
    /// A body that takes part.
    struct Member {
        BodyGroup* group;
        std::size_t index;  ///< in its group
        BodyState own;      ///< before the step, in the batch's units
        BodyState before;   ///< likewise, in the world's units
        BodyPlace place;    ///< likewise, in the world
        Vector6d velocity;  ///< likewise, world axes, relative to the ground
        ContactRecord record;
        double radius;
        double reach;                               ///< m: no point of it moves farther in the step
        bool is_awake;                              ///< whether it moves, or may move
        std::size_t island = ContactBetween::none;  ///< the first member of its island
    };
    /// A gap (m) between two hulls, or a lower bound of it.
    struct KnownGap {
        double gap;
        bool is_whole;  ///< whether it is the gap, not a bound
    };
    /// The bodies of one run, and the data of a step.
    struct Run {
        std::vector<Member> members;
        std::vector<std::pair<double, std::size_t>> order;  ///< by their lowest coordinate along x
        std::vector<IslandStep::Pair> near;                 ///< members whose spheres may touch
        std::vector<IslandStep::Pair> pairs;                ///< of islands
        std::unordered_map<std::uint64_t, KnownGap> gaps;   ///< between hulls before the step
        std::vector<IslandBody> island_bodies;
        std::vector<std::size_t> numbers;
        IslandStep step;
        bool is_guessed = false;  ///< whether the predicted islands of this step have held so far
    };

    void gather(Run& run, std::size_t number, const std::vector<BodyGroup*>& groups,
                const Ground& ground) const;
    static void find_near(Run& run);
    static void find_islands(Run& run);
    static double gap_between(Run& run, std::size_t a, std::size_t b);
    [[nodiscard]] bool went_farther(Run& run, const Ground& ground) const;
    void find_islands_and_step(Run& run, const Surroundings& surroundings, const Ground& ground) const;
    void collide_island(Run& run, const Surroundings& surroundings, const Ground& ground) const;

    double step_;
    int threads_;
    std::vector<Run> runs_;
};

}  // namespace samara
