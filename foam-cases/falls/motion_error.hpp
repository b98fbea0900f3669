#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "samara/analysis/metrics/sampled_falls.hpp"

namespace samara {

/// The uncertainty of the motion by the few directions of a table: for each of baked_metrics the relative
/// standard deviation, and the part that is due to chance.
struct MotionError {
    struct OfMetric {
        double of_table = 0.0;        ///< by the table, without the part by chance
        double of_chance = 0.0;       ///< standard error of an ensemble's mean
        double always_allowed = 0.0;  ///< one degree of amplitude, or of rotation in each L of descent
    };
    PerMetric<std::optional<OfMetric>> metrics;

    /// Returns the largest error of a metric by the table, relative to what the tolerance allows; 0 without
    /// metrics.
    [[nodiscard]] double worst(double tolerance) const;
    /// Returns the largest error of a metric by chance, relative to what the tolerance allows.
    [[nodiscard]] double worst_chance(double tolerance) const;
};

/// The data for drawing random tables that are as likely as the baked one.
struct UncertainTables {
    std::vector<LoadEntryError>
        sampling_errors;             ///< standard errors by the choice of directions, entry by entry
    double reynolds_number = 0.0;    ///< the Reynolds number with all directions
    std::vector<Vector3d> solved;    ///< directions (map axes) with a case
    std::vector<Vector3d> unsolved;  ///< directions that might have one
};

/// Draws a random table that agrees with the tables in the solved directions and differs by the standard
/// errors in the unsolved ones: by a normal deviate of every component that the symmetry allows in each of
/// `unsolved`, interpolated like the tables between them. The same `draw` gives the same table.
LoadTables drawn_tables(const LoadTables& tables, const Symmetry& symmetry, const UncertainTables& uncertain,
                        std::uint32_t draw);

/// Simulates falls of a bake's body over the duration of the scene, alone, with the tables that the body has.
SampledFalls simulate_for_bake(const Scene& scene, std::size_t body, const Body& of_body, int falls);

/// Simulates the body with `draws` random tables, with the same noise and starts and `falls` falls each, and
/// returns the scatter of their metrics about `simulation`, which is of the tables themselves. Metrics that
/// do not characterise the body (tells()) have no error.
MotionError motion_error(const Scene& scene, std::size_t body, const Body& of_body,
                         const UncertainTables& uncertain, const SampledFalls& simulation, int falls,
                         int draws);

}  // namespace samara
