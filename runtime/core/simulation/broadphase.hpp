#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "samara/core/contact/ground_contact.hpp"
#include "samara/core/contact/island.hpp"
#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/simulation/body_group.hpp"

namespace samara {

/// What is known of the gaps between pairs of hulls in a step. It allocates only while it grows.
class KnownGaps {
  public:
    /// Whether a gap is at most `reach` (m).
    struct Gap {
        double reach = 0.0;
        bool is_near = false;
    };

    /// Forgets all.
    void clear();
    /// Returns the place for a pair's gap, and whether it was known.
    std::pair<Gap&, bool> place_of(std::size_t a, std::size_t b);

  private:
    struct Entry {
        std::uint64_t step = 0;  ///< in which it was filled; earlier ones are empty
        std::uint64_t key = 0;
        Gap gap;
    };
    void grow();
    Entry& entry_of(std::uint64_t key);

    std::vector<Entry> entries_;  ///< by hashes of the pairs, with linear probing; a power of two
    std::size_t used_ = 0;
    std::uint64_t step_ = 1;
};

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
    /// The bodies of one run, and the data of a step.
    struct Run {
        std::vector<Member> members;
        std::vector<std::pair<double, std::size_t>> order;  ///< by their lowest coordinate along x
        std::vector<IslandStep::Pair> near;                 ///< members whose spheres may touch
        std::vector<IslandStep::Pair> pairs;                ///< of islands
        std::vector<IslandStep::Pair> island_pairs;         ///< of one island, by the numbers of its bodies
        KnownGaps gaps;                                     ///< between hulls before the step
        std::vector<IslandBody> island_bodies;
        std::vector<std::size_t> numbers;
        IslandStep step;
        bool is_guessed = false;  ///< whether the predicted islands of this step have held so far
    };

    void gather(Run& run, std::size_t number, std::uint64_t step, const Ground& ground) const;
    static void find_near(Run& run);
    static void find_islands(Run& run);
    static bool may_touch(Run& run, std::size_t a, std::size_t b);
    [[nodiscard]] bool went_farther(Run& run, const Ground& ground) const;
    void find_islands_and_step(Run& run, const Surroundings& surroundings, const Ground& ground) const;
    void collide_island(Run& run, const Surroundings& surroundings, const Ground& ground) const;

    double step_;
    int threads_;
    std::vector<Run> runs_;
    std::vector<BodyGroup*> groups_;  ///< those that have started
    std::vector<BatchReport> reports_;
};

}  // namespace samara
