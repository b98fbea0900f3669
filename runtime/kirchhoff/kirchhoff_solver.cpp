#include "samara/kirchhoff/kirchhoff_solver.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/surface/curved_surface.hpp"
#include "samara/core/surface/surface_check.hpp"
#include "samara/core/surface/welded_surface.hpp"
#include "samara/kirchhoff/operators/hypersingular.hpp"
#include "samara/kirchhoff/panels/curved_collocation.hpp"
#include "samara/kirchhoff/solvers/tensor_error.hpp"
#include "samara/kirchhoff/surfaces/surface_ladder.hpp"

namespace samara {
namespace {

// Below this share of its scale a block is within what two surfaces of one body differ by.
constexpr double zero_block = 1e-3;

// A sound surface's solid angles sum up better than this, even where it is very thin; one that overlaps
// itself is off by 1.
constexpr double most_closure_error = 0.05;
// The curved method takes no more: its matrix takes 16 bytes for each pair of triangles.
constexpr std::size_t most_curved_triangles = 6000;
constexpr std::size_t most_flat_triangles = 120000;
// A surface with creases is refined up to this count.
constexpr std::size_t most_refined_triangles = 25000;
constexpr std::size_t quick_triangles = 8000;  // and a second time up to this one
constexpr double most_near_pairs = 6e5;        // where slivers have more, not at all
constexpr int most_rungs = 8;
// Below, triangles that face each other across the body are too near for collocation.
constexpr double least_relative_thickness = 0.2;
// Above this estimate of the curved method the other is tried too.
constexpr double poor_estimate = 0.05;
// Surfaces whose triangles are nearer in size than this are not compared.
constexpr double least_ratio = 1.2;
// The power of the triangles' size that the error falls with, or faster. Coarser surfaces have triangles of
// worse shapes and differ by more than the order says; but where curvature is rebuilt on both, its error is
// alike.
constexpr double order_curved = 4.0;
constexpr double order_rebuilt = 2.0;
constexpr double order_flat = 4.0 / 3.0;
constexpr double order_at_creases = 0.6;  // where triangles are not graded to them
// Shares of the change from the given corners to their refinement: what rebuilt and given curvature, and the
// luck of extrapolation may leave.
constexpr double rebuilt_share = 2.0;
constexpr double curved_share = 0.03;
constexpr double least_share = 0.05;

Surface in_units(Surface surface, const Vector3d& reference_point, double length) {
    for (Vector3d& vertex : surface.vertices) vertex = (vertex - reference_point) / length;
    return surface;
}

/// The surface's solid angles do not sum up: it overlaps or touches itself.
struct OverlapError : Error {
    using Error::Error;
};

struct Solved {
    Matrix6d tensor;  // SI
    double asymmetry = 0.0;
    std::size_t triangles = 0;
    int rung = 0;  // of the ladder: above 0 its triangles cut those of the rung below
    double unresolved = 0.0;
};

/// Returns the relative error that triangles too long to resolve the flow may hide from all coarser surfaces,
/// which keep them: that of a potential taken for linear along them.
double unresolved_by_long_triangles(const Surface& surface) {
    constexpr double long_edge = 0.3;  // over L; those of 100 equal triangles
    constexpr double share = 0.4;      // a disc whose caps are fans about their centres is off by this
    const double whole = surface_area(surface);
    const double length = reference_length(whole);
    double sum = 0.0;
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        const double edge = longest_edge(surface, t) / length;
        if (edge > long_edge) sum += area_vector(surface, t).norm() * edge * edge;
    }
    return share * sum / whole;
}

/// One body, in units of its own size about the reference point, and all that is solved for it.
class Solver {
  public:
    Solver(const Surface& surface, const VolumeMoments& moments, const KirchhoffOptions& options)
        : options_(options),
          scale_{moments.volume, surface_area(surface)},
          length_(reference_length(scale_.surface_area)),
          ladder_(in_units(surface, moments.centroid, length_), options.threads) {}

    KirchhoffTensor run() {
        KirchhoffTensor found = run_chosen();
        tell(1.0);
        return found;
    }

  private:
    KirchhoffTensor run_chosen() {
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

    /// Tells the share done. Progress must not start again from zero with a second method.
    void tell(double share) {
        if (!options_.progress || share < told_) return;
        told_ = share;
        options_.progress(share);
    }

    /// Solves on curved triangles; nothing where these cannot follow so coarse a surface without folding.
    std::optional<KirchhoffTensor> try_curved() {
        try {
            return run_with(KirchhoffMethod::curved_collocation);
        } catch (const Error&) {
            return std::nullopt;
        }
    }

    KirchhoffTensor run_with(KirchhoffMethod method) {
        return options_.tolerance > 0.0 ? climb(method) : solve_own(method);
    }

    /// Solves on the surface's own triangles or their refinement, and on coarser surfaces to compare with.
    KirchhoffTensor solve_own(KirchhoffMethod method) {
        const int rung = method == KirchhoffMethod::hypersingular ? rung_to_refine_to() : 0;
        const int first = rung > 0 ? 0 : -1;
        std::vector<Solved> solved;
        double begin = 0.0;
        for (int i = first; i <= rung; ++i) {
            const double end = std::pow(0.1, rung - i);
            auto next = try_solve(method, i, {begin, end}, i == rung);
            if (next) solved.push_back(std::move(*next));
            begin = end;
        }
        return judged(method, solved);
    }

    /// Returns how often a surface with creases is refined: a polyhedron as far as is quick, a curved one as
    /// far as its own curvature is worth it.
    [[nodiscard]] int rung_to_refine_to() const {
        const Surface& own = ladder_.base().surface;
        const int most = has_straight_edges(own) ? most_rungs : ladder_.is_rebuilt() ? 1 : 2;
        int rung = 0;
        double pairs = 4.0 * near_pairs(own);
        for (std::size_t count = 4 * own.triangle_count(); rung < most; count *= 4, pairs *= 4.0) {
            if (count > (rung == 0 ? most_refined_triangles : quick_triangles) || pairs > most_near_pairs)
                break;
            ++rung;
        }
        return rung;
    }

    /// Solves on coarse surfaces and then finer ones, until the estimate is within the tolerance or no finer
    /// one helps.
    KirchhoffTensor climb(KirchhoffMethod method) {
        std::vector<Solved> solved;
        double begin = 0.0;
        for (int rung = ladder_.lowest();; ++rung) {
            const bool is_last = is_finest(method, rung);
            const double end = 0.5 * (1.0 + begin);
            auto next = try_solve(method, rung, {begin, end}, is_last);
            begin = end;
            if (!next) continue;
            solved.push_back(std::move(*next));
            KirchhoffTensor found = judged(method, solved);
            // Refinement does not reduce the error of the given curvature.
            const bool is_hopeless = rung > 0 && curvature_error(solved) > options_.tolerance;
            if (found.error_estimate <= options_.tolerance || is_last || is_hopeless) return found;
        }
    }

    /// Returns whether finer triangles than the rung's are of no use: they know no more of a smooth body's
    /// curvature than the given ones.
    bool is_finest(KirchhoffMethod method, int rung) {
        if (method == KirchhoffMethod::curved_collocation) return rung >= 0;
        return rung >= 0 && 4 * ladder_.rung(rung).surface.triangle_count() > most_flat_triangles;
    }

    struct Shares {
        double begin;
        double end;
    };

    /// Solves on a rung; nothing where its surface is too coarse to be solved and is not `required`.
    std::optional<Solved> try_solve(KirchhoffMethod method, int rung, const Shares& shares, bool required) {
        try {
            return solve(method, rung, shares);
        } catch (const Error&) {
            if (required) throw;
            return std::nullopt;
        }
    }

    Solved solve(KirchhoffMethod method, int rung, const Shares& shares) {
        const Surface& surface = ladder_.rung(rung).surface;
        const BoundaryElementOptions options{options_.threads, [&](double share) {
                                                 tell(shares.begin + share * (shares.end - shares.begin));
                                             }};
        const BoundaryElementResult found = method == KirchhoffMethod::curved_collocation
                                                ? solve_curved_collocation(surface, options)
                                                : solve_hypersingular(without_edge_nodes(surface), options);
        if (found.closure_error > most_closure_error) {
            throw OverlapError(
                fmt::format("the surface overlaps or touches itself: its solid angle is off by {:.1g}; join "
                            "touching parts into one solid, or mesh thin parts with more triangles",
                            found.closure_error));
        }
        Vector6d powers;
        powers << Vector3d::Constant(length_), Vector3d::Ones();
        Solved solved;
        solved.tensor = std::pow(length_, 3) * powers.asDiagonal() * found.tensor * powers.asDiagonal();
        solved.asymmetry =
            relative_tensor_error(solved.tensor, solved.tensor.transpose(), scale_, zero_block);
        solved.triangles = surface.triangle_count();
        solved.rung = rung;
        solved.unresolved = unresolved_by_long_triangles(surface);
        return solved;
    }

    /// Returns the tensor of the last surface, the finest, and its error by those before.
    [[nodiscard]] KirchhoffTensor judged(KirchhoffMethod method, const std::vector<Solved>& solved) const {
        const Solved& fine = solved.back();
        const bool is_curved = method == KirchhoffMethod::curved_collocation;
        Judgement judgement{fine.tensor, 1.0};
        if (solved.size() > 1 && !is_curved && fine.rung > 0) {
            judgement = extrapolated(solved);
        } else if (solved.size() > 1) {
            judgement.error = carried_on(fine, solved[solved.size() - 2], order_of(method));
        }
        KirchhoffTensor result;
        result.asymmetry = fine.asymmetry;
        // Also where it is not a number.
        const double error =
            std::max({judgement.error, fine.asymmetry, fine.unresolved}) + ladder_.lost_volume();
        result.error_estimate = judgement.error < 1.0 ? std::min(error, 1.0) : 1.0;
        result.matrix = with_positive_energy(0.5 * (judgement.tensor + judgement.tensor.transpose()),
                                             result.error_estimate);
        result.triangles = static_cast<int>(fine.triangles);
        result.method = is_curved ? "direct boundary elements, quadratic on curved triangles"
                                  : "Galerkin boundary elements, hypersingular, linear on flat triangles";
        return result;
    }

    /// Returns the nearest semidefinite tensor. No motion has negative kinetic energy: extrapolation and
    /// quadrature may give one to a motion that moves no fluid, as a disc's about its axis. The tensor is
    /// returned as it is where an energy is below -`share` times the largest.
    [[nodiscard]] Matrix6d with_positive_energy(const Matrix6d& tensor, double share) const {
        Vector6d lengths;
        lengths << Vector3d::Constant(length_), Vector3d::Ones();
        const Matrix6d unscaled =
            lengths.cwiseInverse().asDiagonal() * tensor * lengths.cwiseInverse().asDiagonal();
        const Vector6d energies = eigenvalues_of(unscaled);
        if (energies[0] >= 0.0 || energies[0] < -share * energies[5]) return tensor;
        const Matrix6d nearest = nearest_semidefinite(unscaled);
        return lengths.asDiagonal() * (0.5 * (nearest + nearest.transpose())) * lengths.asDiagonal();
    }

    [[nodiscard]] double order_of(KirchhoffMethod method) const {
        if (method == KirchhoffMethod::curved_collocation) {
            return ladder_.is_rebuilt() ? order_rebuilt : order_curved;
        }
        return any_crease(ladder_.base().creases) ? order_at_creases : order_flat;
    }

    struct Judgement {
        Matrix6d tensor;
        double error;
    };

    [[nodiscard]] double difference(const Matrix6d& one, const Matrix6d& better) const {
        return relative_tensor_error(one, better, scale_, zero_block);
    }

    /// Returns the remaining error on the fine surface: the difference extrapolated to triangles of no size.
    [[nodiscard]] double carried_on(const Solved& fine, const Solved& coarse, double order) const {
        const double ratio =
            std::sqrt(static_cast<double>(fine.triangles) / static_cast<double>(coarse.triangles));
        if (ratio < least_ratio) return 1.0;
        return difference(coarse.tensor, fine.tensor) / (std::pow(ratio, order) - 1.0);
    }

    /// Applies Richardson's extrapolation with the second order that grading gives. What remains is less than
    /// the correction where the order is right, and where three surfaces are nested, about what the
    /// correction changed by. All have the curvature of the given surface, whose error goes with that of flat
    /// triangles.
    [[nodiscard]] Judgement extrapolated(const std::vector<Solved>& solved) const {
        const auto best = [](const Solved& fine, const Solved& coarse) -> Matrix6d {
            return fine.tensor + (fine.tensor - coarse.tensor) / 3.0;
        };
        const std::size_t last = solved.size() - 1;
        const Matrix6d tensor = best(solved[last], solved[last - 1]);
        const double step = difference(solved[last - 1].tensor, solved[last].tensor);
        double error = step / 3.0;
        if (last >= 2 && solved[last - 1].rung > 0) {
            error =
                std::max(difference(best(solved[last - 1], solved[last - 2]), tensor), least_share * step);
        }
        return {tensor, std::max(error, curvature_error(solved))};
    }

    /// Returns the difference that the curvature makes to the given corners, as a share that the rebuilt or
    /// given one is sure to be better than.
    [[nodiscard]] double curvature_error(const std::vector<Solved>& solved) const {
        if (has_straight_edges(ladder_.base().surface)) return 0.0;
        const auto first =
            std::find_if(solved.begin(), solved.end(), [](const Solved& s) { return s.rung == 1; });
        if (first == solved.begin() || first == solved.end()) return 0.0;
        return difference(std::prev(first)->tensor, first->tensor) *
               (ladder_.is_rebuilt() ? rebuilt_share : curved_share);
    }

    const KirchhoffOptions& options_;
    TensorScale scale_;
    double length_;
    SurfaceLadder ladder_;
    double told_ = 0.0;
};

}  // namespace

KirchhoffTensor kirchhoff_tensor(const Surface& given, const VolumeMoments& moments,
                                 const KirchhoffOptions& options) {
    const Surface surface = welded(given);
    require_bounding_surface(surface);
    try {
        return Solver(surface, moments, options).run();
    } catch (const OverlapError&) {
        const Surface flat = with_straight_edge_nodes(surface);
        KirchhoffTensor tensor = Solver(flat, moments, options).run();
        if (surface.order() == 2) {
            const double change = std::abs(enclosed_volume(flat) / moments.volume - 1.0);
            tensor.error_estimate = std::min(1.0, tensor.error_estimate + change);
        }
        return tensor;
    }
}

KirchhoffTensor kirchhoff_tensor(const Body& body, const KirchhoffOptions& options) {
    KirchhoffTensor tensor = kirchhoff_tensor(body.surface, body.moments, options);
    if (body.shape_error) {
        tensor.error_estimate = std::min(
            1.0, tensor.error_estimate + tensor_error_of(*body.shape_error, body.moments, tensor.matrix));
    }
    return tensor;
}

}  // namespace samara
