#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "samara/core/dynamics/immersed_body.hpp"

namespace samara {

/// What was lately made of one body for the steps. Simulations and kinds that differ only in names and starts
/// share it: a crowd of them is made in the time, and takes the memory, of one. Safe to call from several
/// threads.
class PreparedBodies {
  public:
    /// Keeps the `most` that were made last.
    explicit PreparedBodies(std::size_t most = 64) : most_(most) {}
    /// make_immersed_body() of the body, done once for equal physics and fluid. The name is that of whoever
    /// came first. Throws what make_immersed_body throws.
    [[nodiscard]] std::shared_ptr<const ImmersedBody> get(const Body& body, const BodyPhysics& physics,
                                                          const Fluid& fluid, const std::string& name);

  private:
    struct Entry {
        BodyPhysics physics;
        double fluid_density;
        double viscosity;
        std::shared_ptr<const ImmersedBody> body;
    };

    std::size_t most_;
    std::mutex mutex_;
    std::vector<Entry> entries_;  ///< the oldest first
};

}  // namespace samara
