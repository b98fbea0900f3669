// Error against time of the Kirchhoff tensor, for bodies with an exact one: ours and the methods of others,
// on the same meshes. Prints a table, and writes it as a .csv where a file is named.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "samara/kirchhoff/solvers/tensor_error.hpp"
#ifdef SAMARA_ELLIPSOID
#include "meshes/make_body.hpp"
#include "meshes/remeshing/remesh.hpp"
#endif
#include "peers/offset_sources.hpp"
#include "samara/kirchhoff/kirchhoff_solver.hpp"
#include "support/exact_bodies.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

struct Row {
    std::string body;
    std::string method;
    std::size_t triangles = 0;
    double milliseconds = 0.0;
    double error = 0.0;
    double estimate = 0.0;  // 0: the method gives none
};

/// The least time of several runs, in milliseconds.
double time_of(const std::function<void()>& run) {
    using Clock = std::chrono::steady_clock;
    double least = 1e300;
    const auto start = Clock::now();
    int runs = 0;
    do {
        const auto begin = Clock::now();
        run();
        least = std::min(least, std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
        ++runs;
    } while (runs < 30 && (runs < 3 || Clock::now() - start < std::chrono::milliseconds(400)));
    return least;
}

/// A way from a surface (about its centroid) to the tensor.
struct Method {
    const char* name;
    bool is_ours;
    bool curved;  // works on order-2 surfaces
    std::size_t most_triangles;
    std::function<KirchhoffTensor(const Surface&, const VolumeMoments&)> run;
};

KirchhoffTensor as_tensor(const Matrix6d& matrix) {
    KirchhoffTensor tensor;
    tensor.matrix = matrix;
    return tensor;
}

std::vector<Method> methods() {
    const auto offset_sources = [](double offset) {
        return [offset](const Surface& surface, const VolumeMoments&) {
            return as_tensor(peers::offset_source_tensor(surface, offset));
        };
    };
    const auto ours = [](KirchhoffMethod method) {
        return [method](const Surface& surface, const VolumeMoments& moments) {
            return kirchhoff_tensor(surface, moments, {.method = method});
        };
    };
    return {
        {"offset sources (0.1)", false, false, 1280, offset_sources(0.1)},
        {"offset sources (0.6)", false, false, 1280, offset_sources(0.6)},
        {"samara from flat mesh", true, false, 5120, ours(KirchhoffMethod::automatic)},
        {"samara from curved mesh", true, true, 5120, ours(KirchhoffMethod::automatic)},
        {"samara hypersingular", true, false, 1280, ours(KirchhoffMethod::hypersingular)},
    };
}

/// A body of which the tensor is known: its meshes from coarse to fine, and how wrong a tensor is.
struct Case {
    std::string name;
    VolumeMoments moments;
    std::function<Surface(int level, bool curved)> mesh;
    std::function<double(const Matrix6d&)> error;
};

Case ellipsoid_case(const test::ExactEllipsoid& body) {
    const VolumeMoments moments = test::exact_moments(body);
    return {body.name, moments,
            [axes = body.semi_axes](int level, bool curved) {
                return curved ? test::curved_ellipsoid(axes, level) : test::ellipsoid(axes, level);
            },
            [exact = test::exact_tensor(body), moments](const Matrix6d& tensor) {
                return relative_tensor_error(tensor, exact, {moments.volume, moments.surface_area});
            }};
}

Case box_case(const char* name, const Vector3d& edges, const std::function<double(const Matrix6d&)>& error) {
    return {name, test::moments_of(test::box(edges, 1)),
            [edges](int level, bool) { return test::box(edges, 1 << level); }, error};
}

std::vector<Case> cases() {
    std::vector<Case> all;
    for (const test::ExactEllipsoid& body : test::exact_ellipsoids()) all.push_back(ellipsoid_case(body));
    all.push_back(box_case("cube", {1.0, 1.0, 1.0}, [](const Matrix6d& tensor) {
        return relative_tensor_error(tensor, test::unit_cube_tensor(), {1.0, 6.0});
    }));
    // Broadside alone: of a plate without thickness nothing else is known.
    all.push_back(box_case("plate 1:1:0.0001", {1.0, 1.0, 1e-4}, [](const Matrix6d& tensor) {
        return std::abs(tensor(5, 5) / test::unit_plate_added_mass() - 1.0);
    }));
    return all;
}

Row measured(const Case& body, const char* method, const Surface& surface,
             const std::function<KirchhoffTensor()>& run) {
    KirchhoffTensor tensor;
    Row row{body.name, method, surface.triangle_count()};
    row.milliseconds = time_of([&] { tensor = run(); });
    if (tensor.triangles > 0) row.triangles = static_cast<std::size_t>(tensor.triangles);
    row.error = body.error(tensor.matrix);
    row.estimate = tensor.error_estimate;
    return row;
}

/// A polyhedron's triangles are ours to choose: what tolerances give on the coarsest.
std::vector<Row> measure_tolerances(const Case& body) {
    std::vector<Row> rows;
    const Surface surface = body.mesh(1, false);
    for (const double tolerance : {0.1, 0.03, 0.01, 0.003, 0.001}) {
        rows.push_back(measured(body, "samara to a tolerance", surface, [&] {
            return kirchhoff_tensor(surface, body.moments, {.tolerance = tolerance});
        }));
    }
    return rows;
}

std::vector<Row> measure(const Case& body, const Method& method) {
    std::vector<Row> rows;
    const bool is_box = body.mesh(1, true).order() == 1;
    if (is_box && method.is_ours) return rows;
    for (int level = 1; level <= 4; ++level) {
        const Surface surface = body.mesh(level, method.curved);
        if (surface.triangle_count() > method.most_triangles) break;
        rows.push_back(
            measured(body, method.name, surface, [&] { return method.run(surface, body.moments); }));
    }
    return rows;
}

/// The same ellipsoid as samara mesh makes it: from its shape file by gmsh, and from 20,480 facets; none in a
/// build without gmsh.
std::vector<Row> measure_meshed(const Case& body) {
    std::vector<Row> rows;
#ifdef SAMARA_ELLIPSOID
    const Surface facets = body.mesh(5, false);
    for (const int count : {320, 1280, 5120}) {
        MeshOptions options;
        options.triangles = count;
        options.scale = 100.0;  // semi-axes of 1, 2 and 4 m
        const Body made = make_body(SAMARA_ELLIPSOID, options);
        rows.push_back(measured(body, "samara from gmsh mesh", made.surface,
                                [&] { return kirchhoff_tensor(made.surface, body.moments); }));
        const Surface surface = remesh(facets, options, "facets");
        rows.push_back(measured(body, "samara from facets", surface,
                                [&] { return kirchhoff_tensor(surface, body.moments); }));
    }
#else
    (void)body;
#endif
    return rows;
}

void print(const Row& row) {
    fmt::print("{:<18}{:<24}{:>10}{:>12.2f}{:>12.1e}{:>12}\n", row.body, row.method, row.triangles,
               row.milliseconds, row.error, row.estimate > 0.0 ? fmt::format("{:.1e}", row.estimate) : "");
    std::fflush(stdout);
}

}  // namespace
}  // namespace samara

int main(int argc, char** argv) {
    using namespace samara;
    std::vector<Row> rows;
    fmt::print("{:<18}{:<24}{:>10}{:>12}{:>12}{:>12}\n", "body", "method", "triangles", "ms", "error",
               "estimate");
    const auto report = [&](const std::vector<Row>& more) {
        for (const Row& row : more) print(row);
        rows.insert(rows.end(), more.begin(), more.end());
    };
    for (const Case& body : cases()) {
        for (const Method& method : methods()) report(measure(body, method));
        if (body.mesh(1, true).order() == 1) report(measure_tolerances(body));
        if (body.name == "ellipsoid 1:2:4") report(measure_meshed(body));
    }
    if (argc < 2) return 0;
    std::ofstream file(argv[1]);
    file << "body,method,triangles,milliseconds,error,estimate\n";
    for (const Row& row : rows) {
        file << fmt::format("{},{},{},{:.3f},{:.3e},{:.3e}\n", row.body, row.method, row.triangles,
                            row.milliseconds, row.error, row.estimate);
    }
    return file.flush() ? 0 : 1;
}
