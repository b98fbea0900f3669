#include "samara/kirchhoff/kirchhoff_solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "samara/base/error.hpp"
#include "samara/kirchhoff/coarsened_surface.hpp"
#include "samara/kirchhoff/collocation.hpp"
#include "samara/kirchhoff/panels.hpp"
#include "samara/kirchhoff/surface_checks.hpp"
#include "samara/kirchhoff/tensor_error.hpp"

namespace samara {
namespace {

// A closed surface's solid angles sum up to 4e-15; a missing or flipped triangle shows as 1e-2 and more.
constexpr double most_closure_fault = 1e-6;
// Below this share of its scale a block is within what two surfaces of one body differ by.
constexpr double zero_block = 1e-3;
// An estimate above this says only that the coarse surface is too coarse, for the body's thickness say.
constexpr double most_useful_estimate = 0.5;
// An edge that turns by more than this is held to be one of the body. The potential there goes as the
// distance to the power 2/3 at a right angle, and the error falls no faster than that power is sure to.
constexpr double crease_angle = 1.0;  // radians
constexpr double order_at_creases = 2.0 / 3.0;
// Surfaces whose triangles are nearer in size than this are not compared.
constexpr double least_size_ratio = 1.2;

/// A surface of order 1 and its tensor in SI units, as solved.
struct Solved {
    Surface surface;
    Matrix6d tensor;
    TensorScale scale;
    double closure_fault = 0.0;
    double asymmetry = 0.0;

    [[nodiscard]] bool closed() const { return closure_fault <= most_closure_fault; }
};

Solved solve_flat(Surface surface, const VolumeMoments& moments, const KirchhoffOptions& options) {
    const TensorScale scale{moments.volume, surface_area(surface)};
    const double length = reference_length(scale.surface_area);
    const Panels panels = make_panels(surface, moments.centroid, length);
    const CollocationResult result =
        solve_collocation(panels, most_closure_fault, options.threads, options.progress);
    Vector6d powers;
    powers << Vector3d::Constant(length), Vector3d::Ones();
    const Matrix6d tensor = std::pow(length, 3) * powers.asDiagonal() * result.tensor * powers.asDiagonal();
    const double asymmetry = relative_tensor_error(tensor, tensor.transpose(), scale, zero_block);
    return {std::move(surface), tensor, scale, result.closure_fault, asymmetry};
}

void require_sound(const Surface& surface) {
    if (surface.triangle_count() < 4) throw Error("the surface has fewer than four triangles; it is no body");
    const std::size_t panels = surface.triangle_count() * (surface.order() == 2 ? 4 : 1);
    if (panels > most_panels) {
        throw Error(
            fmt::format("the surface has {} flat triangles, more than the {} that can be solved for; "
                        "mesh the shape with fewer (--triangles)",
                        panels, most_panels));
    }
    if (std::string fault = edge_fault(surface); !fault.empty()) {
        throw Error(fmt::format(
            "the surface is not closed and outward: {}; mesh the shape again with 'samara mesh'", fault));
    }
    if (!(signed_volume(surface) > 0.0)) {
        throw Error(
            "the surface is turned inside out (its volume is negative); mesh the shape again with "
            "'samara mesh'");
    }
}

void require_closed(const Solved& solved) {
    if (solved.closed()) return;
    throw Error(
        fmt::format("the surface overlaps or touches itself: its solid angle is off by {:.1g}; mesh "
                    "the shape again with 'samara mesh'",
                    solved.closure_fault));
}

Surface fine_surface(const Surface& surface) {
    return surface.order() == 2 ? subdivided(surface) : surface;
}

/// The surfaces to compare with, the best first: their vertices are some of the given ones. Where there are
/// creases the error falls slowly, and a quarter of the triangles tell more than half of them.
std::vector<Surface> coarse_surfaces(const Surface& surface) {
    if (surface.order() == 2) {
        Surface corners = surface;
        corners.edge_nodes.clear();
        return {corners};
    }
    const Surface half = coarsened(surface, surface.triangle_count() / 2);
    if (!has_creases(surface, crease_angle)) return {half};
    return {coarsened(half, surface.triangle_count() / 4), half};
}

/// The ratio of the triangles' sizes on two surfaces of one body.
double size_ratio(const Surface& fine, const Surface& coarse) {
    return std::sqrt(static_cast<double>(fine.triangle_count()) /
                     static_cast<double>(coarse.triangle_count()));
}

/// What is left of the error on the fine surface: the difference carried on to triangles of no size.
double extrapolated_error(const Solved& fine, const Solved& coarse) {
    const double order = has_creases(fine.surface, crease_angle) ? order_at_creases : 1.0;
    return relative_tensor_error(coarse.tensor, fine.tensor, fine.scale, zero_block) /
           (std::pow(size_ratio(fine.surface, coarse.surface), order) - 1.0);
}

/// What the flatness of the triangles costs, from the volumes: the tensor's blocks grow with the volume's
/// power up to 5/3.
double flatness_error(const Surface& fine, const Surface& coarse) {
    const double ratio = size_ratio(fine, coarse);
    if (!(ratio > least_size_ratio)) return 0.0;  // nothing could be merged: there are creases alone
    return 5.0 / 3.0 * std::abs(signed_volume(coarse) / signed_volume(fine) - 1.0) / (ratio - 1.0);
}

KirchhoffTensor as_result(const Solved& solved, double error_estimate) {
    KirchhoffTensor result;
    result.matrix = 0.5 * (solved.tensor + solved.tensor.transpose());
    result.error_estimate = std::max(error_estimate, solved.asymmetry);
    result.asymmetry = solved.asymmetry;
    result.triangles = static_cast<int>(solved.surface.triangle_count());
    result.method = "direct boundary elements, constant on flat triangles";
    return result;
}

}  // namespace

KirchhoffTensor kirchhoff_tensor(const Surface& surface, const VolumeMoments& moments,
                                 const KirchhoffOptions& options) {
    require_sound(surface);
    const Solved fine = solve_flat(fine_surface(surface), moments, options);
    require_closed(fine);
    const std::vector<Surface> coarse_ones = coarse_surfaces(surface);
    for (const Surface& coarse : coarse_ones) {
        if (size_ratio(fine.surface, coarse) < least_size_ratio) continue;
        const Solved compared = solve_flat(coarse, moments, {options.threads, {}});
        const double error = extrapolated_error(fine, compared);
        if (compared.closed() && error < most_useful_estimate) return as_result(fine, error);
    }
    if (4 * fine.surface.triangle_count() > most_panels) {
        return as_result(fine, 1.0);  // nothing is known of it
    }
    const Solved finer = solve_flat(subdivided(fine.surface), moments, options);
    return as_result(finer,
                     extrapolated_error(finer, fine) + flatness_error(fine.surface, coarse_ones.back()));
}

}  // namespace samara
