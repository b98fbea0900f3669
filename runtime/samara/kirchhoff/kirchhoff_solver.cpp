#include "samara/kirchhoff/kirchhoff_solver.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "samara/base/error.hpp"
#include "samara/body/curved_surface.hpp"
#include "samara/kirchhoff/curved_collocation.hpp"
#include "samara/kirchhoff/hypersingular.hpp"
#include "samara/kirchhoff/surface_checks.hpp"
#include "samara/kirchhoff/surface_ladder.hpp"
#include "samara/kirchhoff/tensor_error.hpp"
#include "samara/kirchhoff/thickness.hpp"

namespace samara {
namespace {

// Below this share of its scale a block is within what two surfaces of one body differ by.
constexpr double zero_block = 1e-3;

// A sound surface's solid angles sum up better than this, even where it is very thin; one that overlaps
// itself is off by 1.
constexpr double most_closure_fault = 0.05;
// Of the curved method, whose matrix takes 64 bytes for each pair of triangles.
constexpr std::size_t most_curved_triangles = 6000;
constexpr std::size_t most_flat_triangles = 120000;
// A surface with creases is refined once, if it then has no more than the first, and again up to the second.
constexpr std::size_t most_refined_triangles = 8000;
constexpr std::size_t least_refined_triangles = 1200;
// Below, triangles that face each other across the body are too near for collocation.
constexpr double least_relative_thickness = 0.2;
// Above this estimate of the curved method the other is tried too.
constexpr double poor_estimate = 0.05;
// Surfaces whose triangles are nearer in size than this are not compared.
constexpr double least_ratio = 1.2;
// With which the error falls with the triangles' size, or is sure to.
// Coarser surfaces have triangles of worse shapes and differ by more than the order says; but where curvature
// is rebuilt on both, its error is alike.
constexpr double order_curved = 4.0;
constexpr double sure_order_rebuilt = 2.0;
constexpr double rebuilt_share = 1.3;
constexpr double sure_order_flat = 4.0 / 3.0;

Surface in_units(Surface surface, const Vector3d& reference_point, double length) {
    for (Vector3d& vertex : surface.vertices) vertex = (vertex - reference_point) / length;
    return surface;
}

struct Solved {
    Matrix6d tensor;  // SI
    double asymmetry = 0.0;
    std::size_t triangles = 0;
};

/// One body, in units of its own size about the reference point, and all that is solved for it.
class Solver {
  public:
    Solver(const Surface& surface, const VolumeMoments& moments, const KirchhoffOptions& options)
        : options_(options),
          scale_{moments.volume, surface_area(surface)},
          length_(reference_length(scale_.surface_area)),
          ladder_(in_units(surface, moments.centroid, length_), options.threads) {}

    KirchhoffTensor run() {
        if (options_.method != KirchhoffMethod::automatic) return run_with(options_.method);
        const CreasedSurface& base = ladder_.base();
        const bool is_smooth = !any_crease(base.creases) &&
                               base.surface.triangle_count() <= most_curved_triangles &&
                               relative_thickness(base.surface) > least_relative_thickness;
        if (!is_smooth) return run_with(KirchhoffMethod::hypersingular);
        const std::optional<KirchhoffTensor> curved = try_curved();
        if (curved && curved->error_estimate <= poor_estimate) return *curved;
        const KirchhoffTensor flat = run_with(KirchhoffMethod::hypersingular);
        return curved && curved->error_estimate <= flat.error_estimate ? *curved : flat;
    }

  private:
    /// Nothing where curved triangles cannot follow so coarse a surface without folding.
    std::optional<KirchhoffTensor> try_curved() {
        try {
            return run_with(KirchhoffMethod::curved_collocation);
        } catch (const Error&) {
            return std::nullopt;
        }
    }

    KirchhoffTensor run_with(KirchhoffMethod method) {
        KirchhoffTensor found = options_.tolerance > 0.0 ? climb(method) : compare_two(method);
        if (options_.progress) options_.progress(1.0);
        return found;
    }

    /// The surface's own triangles, and a coarser or finer surface to compare with.
    KirchhoffTensor compare_two(KirchhoffMethod method) {
        int rung = 0;
        if (method == KirchhoffMethod::hypersingular) {
            std::size_t count = 4 * ladder_.base().surface.triangle_count();
            if (count <= most_refined_triangles) rung = 1;
            for (; 4 * count <= least_refined_triangles; count *= 4) ++rung;
        }
        const Solved coarse = solve(method, rung - 1, {0.0, 0.1});
        return compared(method, solve(method, rung, {0.1, 1.0}), coarse, rung > 0);
    }

    /// From coarse surfaces to finer ones, until the estimate is within the tolerance or no finer one helps.
    KirchhoffTensor climb(KirchhoffMethod method) {
        double begin = 0.0;
        std::optional<Solved> coarse;
        for (int rung = ladder_.lowest();; ++rung) {
            const bool is_last = is_finest(method, rung);
            std::optional<Solved> fine;
            try {
                fine = solve(method, rung, {begin, 0.5 * (1.0 + begin)});
            } catch (const Error&) {
                if (is_last) throw;  // below, a surface too coarse to be one is no fault of the given one
            }
            begin = 0.5 * (1.0 + begin);
            if (fine && coarse) {
                const KirchhoffTensor found = compared(method, *fine, *coarse, rung > 0);
                if (found.error_estimate <= options_.tolerance || is_last) return found;
            } else if (is_last) {
                return compared(method, *fine, *fine, false);
            }
            coarse = std::move(fine);
        }
    }

    /// Whether finer triangles than the rung's are of no use: they know no more of a smooth body's curvature
    /// than the given ones.
    bool is_finest(KirchhoffMethod method, int rung) {
        if (method == KirchhoffMethod::curved_collocation) return rung >= 0;
        return rung >= 0 && 4 * ladder_.rung(rung).surface.triangle_count() > most_flat_triangles;
    }

    struct Shares {
        double begin;
        double end;
    };

    Solved solve(KirchhoffMethod method, int rung, const Shares& shares) {
        const Surface& surface = ladder_.rung(rung).surface;
        BoundaryElementOptions options{options_.threads, {}};
        if (options_.progress) {
            options.progress = [&](double share) {
                options_.progress(shares.begin + share * (shares.end - shares.begin));
            };
        }
        const BoundaryElementResult found = method == KirchhoffMethod::curved_collocation
                                                ? solve_curved_collocation(surface, options)
                                                : solve_hypersingular(without_edge_nodes(surface), options);
        if (found.closure_fault > most_closure_fault) {
            throw Error(
                fmt::format("the surface overlaps or touches itself: its solid angle is off by {:.1g}; "
                            "mesh the shape again with 'samara mesh'",
                            found.closure_fault));
        }
        Vector6d powers;
        powers << Vector3d::Constant(length_), Vector3d::Ones();
        Solved solved;
        solved.tensor = std::pow(length_, 3) * powers.asDiagonal() * found.tensor * powers.asDiagonal();
        solved.asymmetry =
            relative_tensor_error(solved.tensor, solved.tensor.transpose(), scale_, zero_block);
        solved.triangles = surface.triangle_count();
        return solved;
    }

    /// `nested`: the finer surface cuts the coarser one's triangles.
    KirchhoffTensor compared(KirchhoffMethod method, const Solved& fine, const Solved& coarse,
                             bool nested) const {
        const double difference = relative_tensor_error(coarse.tensor, fine.tensor, scale_, zero_block);
        const double ratio =
            std::sqrt(static_cast<double>(fine.triangles) / static_cast<double>(coarse.triangles));
        const bool is_curved = method == KirchhoffMethod::curved_collocation;
        Matrix6d tensor = fine.tensor;
        double estimate = 1.0;
        if (!is_curved && nested) {
            // Richardson, for the second order that grading gives; what remains is less where that is right.
            // A rebuilt curvature is the same on both, and its error of the size of what it differs by from
            // flat.
            tensor += (fine.tensor - coarse.tensor) / 3.0;
            const bool is_polyhedron = has_straight_edges(ladder_.base().surface);
            estimate = difference * (ladder_.is_rebuilt() && !is_polyhedron ? rebuilt_share : 1.0 / 3.0);
        } else if (ratio > least_ratio) {
            const double order = !is_curved             ? sure_order_flat
                                 : ladder_.is_rebuilt() ? sure_order_rebuilt
                                                        : order_curved;
            estimate = difference / (std::pow(ratio, order) - 1.0);
        }
        KirchhoffTensor result;
        result.matrix = 0.5 * (tensor + tensor.transpose());
        result.asymmetry = fine.asymmetry;
        result.error_estimate = std::min(1.0, std::max(estimate, fine.asymmetry));
        result.triangles = static_cast<int>(fine.triangles);
        result.method = is_curved ? "direct boundary elements, quadratic on curved triangles"
                                  : "Galerkin boundary elements, hypersingular, linear on flat triangles";
        return result;
    }

    const KirchhoffOptions& options_;
    TensorScale scale_;
    double length_;
    SurfaceLadder ladder_;
};

}  // namespace

KirchhoffTensor kirchhoff_tensor(const Surface& given, const VolumeMoments& moments,
                                 const KirchhoffOptions& options) {
    const Surface surface = sound_surface(given);
    return Solver(surface, moments, options).run();
}

}  // namespace samara
