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

/// Takes the steps of bodies that touch each other, all kinds together; those of different runs never meet.
/// A step depends on the bodies' states before it alone, not on threads or earlier steps.
///
/// Bodies that may come to touch in a step are a island: they fly alone as if there were neither ground nor
/// obstacles, and IslandStep makes of it what these and the others allow. All others fly as ever.
class Broadphase {
  public:
    explicit Broadphase(double step = 0.0, int runs = 0, int threads = 1);

    /// The flight's step number `number` of all kinds that have begun by then. Throws what
    /// BodyGroup::keep_steps throws.
    void take_step(const std::vector<std::unique_ptr<BodyGroup>>& groups, const Surroundings& surroundings,
                   std::uint64_t number);

  private:
    /// A body that is there.
    struct Member {
        BodyGroup* group;
        std::size_t index;  ///< in its kind
        BodyState own;      ///< before the step, in the batch's numbers
        BodyState before;   ///< the same in the world's
        BodyPlace place;    ///< the same, in the world
        Vector6d velocity;  ///< the same, world axes, relative to the ground
        ContactRecord record;
        double radius;
        double reach;                               ///< m: no point of it comes farther in the step
        bool is_awake;                              ///< moves, or may
        std::size_t island = ContactBetween::none;  ///< number of the first of those that it is with
    };
    /// A gap (m) between two hulls, or what it is at least.
    struct KnownGap {
        double gap;
        bool is_whole;  ///< whether it is the gap, not a bound
    };
    /// The bodies of one run, and what is thought of them in a step.
    struct Run {
        std::vector<Member> members;
        std::vector<std::pair<double, std::size_t>> order;  ///< by where they begin along x
        std::vector<IslandStep::Pair> near;                 ///< whose spheres may meet
        std::vector<IslandStep::Pair> pairs;                ///< of islands
        std::unordered_map<std::uint64_t, KnownGap> gaps;   ///< between hulls before the step
        std::vector<IslandBody> island_bodies;
        std::vector<std::size_t> numbers;
        IslandStep step;
        bool is_guessed = false;  ///< whether the islands of this step have held so far
    };

    void gather(Run& run, std::size_t number, const std::vector<BodyGroup*>& groups,
                const Ground& ground) const;
    static void find_near(Run& run);
    static void find_islands(Run& run);
    static double gap_between(Run& run, std::size_t a, std::size_t b);
    [[nodiscard]] bool went_farther(Run& run, const Ground& ground) const;
    void meet(Run& run, const Surroundings& surroundings, const Ground& ground) const;
    void collide_island(Run& run, const Surroundings& surroundings, const Ground& ground) const;

    double step_;
    int threads_;
    std::vector<Run> runs_;
};

}  // namespace samara
