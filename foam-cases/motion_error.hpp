#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "foam-cases/scene_flight.hpp"

namespace samara {

/// What the few directions of a table leave uncertain in the motion: for each measure the standard deviation
/// over the measure (relative), and what of it chance alone makes.
struct MotionError {
    struct OfMeasure {
        double of_table = 0.0;        ///< from the table, less what chance makes
        double of_chance = 0.0;       ///< standard error of an ensemble's mean
        double always_allowed = 0.0;  ///< one degree of the amplitude, a turn by it in each L of the descent
    };
    std::array<std::optional<OfMeasure>, fall_measure_count> measures;

    /// The largest of the measures' errors from the table over what the tolerance allows of it; 0 without
    /// measures.
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

/// Flies `draws` of the body's tables with the same noise and starts, `falls` each, and takes the scatter of
/// their measures about `flight`, which is of the tables themselves.
MotionError motion_error(const Scene& scene, std::size_t body, const Body& of_body,
                         const UncertainTables& uncertain, const EnsembleFlight& flight, int falls,
                         int draws);

}  // namespace samara
