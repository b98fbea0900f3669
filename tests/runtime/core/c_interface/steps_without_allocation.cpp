// A program of its own: it counts what the whole process allocates. Once a simulation has made its buffers,
// frames of it take no memory from the heap, whatever the bodies do.
#include <atomic>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "paths.hpp"
#include "samara.h"

namespace {
std::atomic<long> allocations = 0;
}

__attribute__((noinline)) void* operator new(std::size_t size) {
    ++allocations;
    if (void* memory = std::malloc(size)) return memory;
    throw std::bad_alloc();
}
__attribute__((noinline)) void* operator new(std::size_t size, std::align_val_t alignment) {
    ++allocations;
    const auto align = static_cast<std::size_t>(alignment);
    if (void* memory = std::aligned_alloc(align, (size + align - 1) / align * align)) return memory;
    throw std::bad_alloc();
}
__attribute__((noinline)) void operator delete(void* memory) noexcept {
    std::free(memory);
}
__attribute__((noinline)) void operator delete(void* memory, std::size_t /*size*/) noexcept {
    std::free(memory);
}
__attribute__((noinline)) void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept {
    std::free(memory);
}
__attribute__((noinline)) void operator delete(void* memory, std::size_t /*size*/,
                                               std::align_val_t /*alignment*/) noexcept {
    std::free(memory);
}

namespace {

char error[512];

void check(samara_status status) {
    ASSERT_EQ(status, SAMARA_OK) << error;
}

/// Returns how often the frames of a second allocate, after those of `warm_up` (s). The bodies are drawn into
/// a heap.
long allocations_of_a_second(bool collide, const char* wind, double warm_up) {
    samara_settings settings;
    check(samara_default_settings(&settings, sizeof settings, error, sizeof error));
    settings.fluid_density = 1.204;
    settings.fluid_viscosity = 1.825e-5;
    settings.has_ground = 1;
    settings.bodies_collide = collide ? 1 : 0;
    settings.threads = 1;
    samara_simulation* simulation = nullptr;
    check(samara_simulation_create(&settings, &simulation, error, sizeof error));
    samara_body* body = nullptr;
    check(
        samara_body_load(SAMARA_SOURCE_DIRECTORY "/runtime/bodies/leaf.body.h5", &body, error, sizeof error));
    samara_body_group group;
    check(samara_default_body_group(&group, sizeof group, error, sizeof error));
    group.count = 40;
    group.position[2] = 0.5;
    for (const int axis : {0, 1}) group.spread_position[axis] = 0.08;
    group.spread_position[2] = 0.3;
    group.spread_angle = 3.0;
    check(samara_simulation_add(simulation, body, &group, nullptr, error, sizeof error));
    if (wind != nullptr) check(samara_set_wind(simulation, wind, error, sizeof error));
    std::vector<samara_pose> poses(group.count);
    const auto frame = [&](double time) {
        check(samara_advance_to(simulation, time, error, sizeof error));
        check(samara_get_poses(simulation, 0, poses.size(), poses.data(), 0, error, sizeof error));
    };
    for (int i = 1; i <= 60.0 * warm_up; ++i) frame(i / 60.0);
    const long before = allocations;
    for (int i = 1; i <= 60; ++i) frame(warm_up + i / 60.0);
    const long taken = allocations - before;
    samara_simulation_free(simulation);
    samara_body_free(body);
    return taken;
}

TEST(Frames, OfACrowdAllocateNothing) {
    EXPECT_EQ(allocations_of_a_second(false, nullptr, 0.2), 0);
}

TEST(Frames, InAWindAllocateNothing) {
    EXPECT_EQ(allocations_of_a_second(false, "gusts = { rms = 0.5, length = 1 }", 0.2), 0);
}

TEST(Frames, OfBodiesThatCollideAllocateLessThanOnceInTenFramesOnceTheyHaveMet) {
    // A buffer grows where more bodies meet than ever before.
    EXPECT_LE(allocations_of_a_second(true, nullptr, 1.5), 6);
}

}  // namespace
