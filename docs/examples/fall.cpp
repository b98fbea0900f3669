// Drops leaves in air, prints where they are 24 times a second, and plays the second half again.
//
//   c++ -std=c++20 fall.cpp $(pkg-config --cflags --libs samara) -o fall      or, with CMake:
//     find_package(samara REQUIRED)
//     add_executable(fall fall.cpp)
//     target_link_libraries(fall PRIVATE samara::runtime)
//
//   ./fall leaf.body.h5
#include <cstdio>
#include <vector>

#include <samara/core/simulation/simulation.hpp>

namespace {

/// Plays frames `first` to `last` and returns the poses of the last one.
std::vector<samara::Pose> play(samara::Simulation& simulation, int first, int last, bool print) {
    std::vector<samara::Pose> poses(simulation.size());
    for (int frame = first; frame <= last; ++frame) {
        simulation.advance_to(frame / 24.0);
        simulation.poses(0, poses.size(), poses.data());
        for (std::size_t i = 0; print && i < poses.size(); ++i) {
            const auto& at = poses[i].position;
            std::printf("%.4f s  leaf %zu at %8.4f %8.4f %8.4f m\n", simulation.time(), i, at.x(), at.y(),
                        at.z());
        }
    }
    return poses;
}

}  // namespace

int main(int count, char** words) {
    if (count != 2) {
        std::fputs("Usage: fall NAME.body.h5\n", stderr);
        return 1;
    }
    try {
        const samara::LoadedBody leaf = samara::load_body_file(words[1]);
        samara::Simulation simulation(
            {.fluid = *samara::fluid_preset("air"), .ground = -1.0, .step = 0.001, .seed = 7});
        samara::BodyPhysics physics;
        physics.mass.density = 600.0;
        simulation.add(leaf, physics, {.count = 3, .spread_angle = 0.5});

        play(simulation, 0, 12, true);
        const std::string halfway = simulation.state();
        const auto once = play(simulation, 13, 24, true);
        simulation.set_state(halfway);
        const auto again = play(simulation, 13, 24, false);
        for (std::size_t i = 0; i < once.size(); ++i) {
            if (once[i].position == again[i].position) continue;
            std::fputs("fall: the second half did not come out the same\n", stderr);
            return 1;
        }
        const samara::StepReport report = simulation.report();
        std::printf("%llu steps, Reynolds numbers up to %.0f\n",
                    static_cast<unsigned long long>(report.steps), report.highest_reynolds_number);
    } catch (const samara::Error& error) {
        std::fprintf(stderr, "fall: %s\n", error.what());
        return 1;
    }
    return 0;
}
