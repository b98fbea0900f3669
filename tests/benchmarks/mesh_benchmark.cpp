// Time to make a body of a file of triangles: reading, checks, reduction, meshing and symmetry.

#include <filesystem>
#include <fstream>

#include <benchmark/benchmark.h>

#include "meshes/make_body.hpp"
#include "samara/core/files/folders.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

void write_obj(const std::filesystem::path& file, const Surface& surface) {
    std::ofstream stream(file);
    stream.precision(9);
    for (const Vector3d& p : surface.vertices) {
        stream << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    }
    for (const auto& [a, b, c] : surface.corners) {
        stream << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
    }
}

// Icospheres of level 5, 20,480 triangles, and 8, 1,310,720.
void mesh_of_ellipsoid(benchmark::State& state) {
    const TemporaryFolder folder;
    const Surface surface = test::ellipsoid({0.01, 0.02, 0.04}, static_cast<int>(state.range(0)));
    const std::filesystem::path file = folder.path() / "ellipsoid.obj";
    write_obj(file, surface);
    Body body;
    while (state.KeepRunning()) {
        body = make_body(file);
        benchmark::DoNotOptimize(body);
    }
    constexpr double volume = 3.3510321638291125e-5;
    state.counters["triangles_read"] = static_cast<double>(surface.triangle_count());
    state.counters["triangles_made"] = static_cast<double>(body.surface.triangle_count());
    state.counters["volume_error"] = body.moments.volume / volume - 1.0;
}

BENCHMARK(mesh_of_ellipsoid)->Arg(5)->Arg(8)->Unit(benchmark::kSecond)->UseRealTime();

}  // namespace
}  // namespace samara
