#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "samara/analysis/metrics/sampled_falls.hpp"

namespace samara {

/// What the few directions of a table leave uncertain in the motion: for each of baked_metrics the standard
/// deviation over the figure (relative), and what of it chance alone makes.
struct MotionError {
    struct OfMetric {
        double of_table = 0.0;        ///< from the table, less what chance makes
        double of_chance = 0.0;       ///< standard error of an ensemble's mean
        double always_allowed = 0.0;  ///< one degree of the amplitude, a turn by it in each L of the descent
    };
    PerMetric<std::optional<OfMetric>> metrics;

    /// The largest of the figures' errors from the table over what the tolerance allows of it; 0 without
    /// figures.
    [[nodiscard]] double worst(double tolerance) const;
    /// The same of what chance makes.
    [[nodiscard]] double worst_chance(double tolerance) const;
};

/// What is needed to draw tables that might as well have been baked.
struct UncertainTables {
    std::vector<LoadEntryError> sampling_errors;  ///< standard errors of the directions alone, entry by entry
    double reynolds_number = 0.0;                 ///< the one with all the directions
    std::vector<Vector3d> solved;                 ///< directions (map axes) with a case
    std::vector<Vector3d> unsolved;               ///< those that might have one
};

/// Draws of tables whose unsolved directions differ by their standard errors, and that agree in the solved
/// ones: in each of `unsolved` a normal deviate of every component that the symmetry allows, between them the
/// tables' own interpolation. The same draw for the same number.
LoadTables drawn_tables(const LoadTables& tables, const Symmetry& symmetry, const UncertainTables& uncertain,
                        std::uint32_t draw);

/// How falls of a bake's body are flown: as long as the scene is, alone, with the tables that the body has.
SampledFalls fly_for_bake(const Scene& scene, std::size_t body, const Body& of_body, int falls);

/// Flies `draws` of the body's tables with the same noise and starts, `falls` each, and takes the scatter of
/// their figures about `flight`, which is of the tables themselves. No error of what tells nothing of the
/// body (tells()).
MotionError motion_error(const Scene& scene, std::size_t body, const Body& of_body,
                         const UncertainTables& uncertain, const SampledFalls& simulation, int falls,
                         int draws);

}  // namespace samara
