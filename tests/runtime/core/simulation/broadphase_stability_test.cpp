// Heaps: thin cards that tumble, needles, bodies that are poured on one spot.

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "support/colliding_bodies.hpp"
#include "support/stability_row.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

constexpr double gravity = 9.81;

std::string in_words(double step) {
    return step < 0.01 ? "2 ms" : "1/24 s";
}

struct Heap {
    std::string name;
    Vector3d edges;
    int count;
    double turn = 0.0;  ///< rad: of all at the start
};

/// Extremes while a heap fell together.
struct Seen {
    double rise = 0.0;     ///< of the energy in a step, over the weight of a body times its radius
    double deepest = 0.0;  ///< below the ground, over the radius
    double overlap = 0.0;  ///< of two bodies at the end, over the radius
    double moving = 0.0;   ///< bodies that are not at rest at the end
};

Seen fallen_together(const Heap& heap, double step, double duration) {
    SimulationSettings settings = test::colliding_in_vacuum(gravity, step);
    settings.ground = 0.0;
    Simulation simulation(settings);
    const LoadedBody body = test::body_of(test::box(heap.edges, 2));
    const double radius = 0.5 * heap.edges.norm();
    for (int i = 0; i < heap.count; ++i) {
        simulation.add(
            body, test::without_fluid(700.0),
            {.position = {0.01 * std::sin(1.7 * i), 0.01 * std::cos(2.3 * i),
                          3.0 * radius + 2.1 * radius * i},
             .orientation = Quaterniond(Eigen::AngleAxisd(
                 0.7 * i + heap.turn, Vector3d(std::sin(0.9 * i), std::cos(1.3 * i), 0.4).normalized())),
             .angular_velocity = {3.0 * std::sin(2.1 * i), 2.0, 1.0}},
            "body-" + std::to_string(i));
    }
    Seen seen;
    double energy = test::energy_of(simulation, gravity);
    const auto count = static_cast<int>(std::lround(duration / step));
    for (int i = 1; i <= count; ++i) {
        simulation.advance_to(step * i);
        const double now = test::energy_of(simulation, gravity);
        seen.rise = std::max(seen.rise, (now - energy) / (simulation.mass(0) * gravity * radius));
        energy = now;
        for (std::size_t k = 0; k < simulation.size(); ++k) {
            seen.deepest = std::max(seen.deepest, -test::lowest_point(simulation, k) / radius);
        }
    }
    seen.overlap = test::deepest_overlap(simulation) / radius;
    for (std::size_t k = 0; k < simulation.size(); ++k) seen.moving += simulation.is_at_rest(k) ? 0.0 : 1.0;
    return seen;
}

void expect_calm(const Heap& heap, double duration) {
    for (const double step : {0.002, 1.0 / 24.0}) {
        const Seen seen = fallen_together(heap, step, duration);
        const std::string words = in_words(step);
        test::expect_row(
            {heap.name, words, "largest rise of E in a step, over m g R of a body", 0.02, seen.rise});
        test::expect_row({heap.name, words, "depth below the ground, over R", 1e-3, seen.deepest});
        test::expect_row({heap.name, words, "overlap of two at the end, over R", 1e-3, seen.overlap});
        test::expect_row({heap.name, words, "bodies that move at the end", 0.0, seen.moving});
    }
}

TEST(BroadphaseStability, ThinCardsThatTumbleOntoEachOtherComeToRest) {
    expect_calm({"20 cards, 120 times as long as thick, on one spot", {0.06, 0.04, 0.0005}, 20}, 4.0);
}

TEST(BroadphaseStability, NeedlesComeToRest) {
    expect_calm({"20 needles on one spot", {0.05, 0.0008, 0.0008}, 20}, 4.0);
}

TEST(BroadphaseStability, WhatLiesUnderAHeapDoesNotSinkIntoEachOther) {
    // Starts with which the lowest two would, as their gap is used up.
    for (const Heap& heap : {Heap{"20 cards, turned by 0.51", {0.06, 0.04, 0.0005}, 20, 0.51},
                             Heap{"20 needles, turned by 1.34", {0.05, 0.0008, 0.0008}, 20, 1.34}}) {
        const Seen seen = fallen_together(heap, 0.002, 4.0);
        test::expect_row(
            {heap.name, in_words(0.002), "overlap of two at the end, over R", 1e-3, seen.overlap});
        test::expect_row({heap.name, in_words(0.002), "bodies that move at the end", 0.0, seen.moving});
    }
}

TEST(BroadphaseStability, SixtyBlocksPouredOnOneSpotComeToRest) {
    expect_calm({"60 blocks poured on one spot", {0.02, 0.015, 0.01}, 60}, 4.0);
}

}  // namespace
}  // namespace samara
