// Whether the tables' standard errors hold what they say: laws that are known, cases with seeded errors.

#include <array>
#include <cmath>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "converter/tables/direction_sampling.hpp"
#include "converter/tables/model_errors.hpp"
#include "load_laws.hpp"
#include "symmetry_groups.hpp"
#include "table_cases.hpp"

namespace samara {
namespace {

using Law = std::function<LoadEntry(const Vector3d&)>;

/// The errors of the cases. Those of vectors are relative to their length.
struct CaseErrors {
    double noise = 0.0;  ///< of each component and of k and epsilon, independent
    double mesh = 0.0;   ///< of the table's mesh, the same sense everywhere; twice as much on the coarser one
    double closure = 0.0;  ///< of the logarithms of k and epsilon: each closure's deviation from the truth
};

class Errors {
  public:
    Errors(const CaseErrors& sizes, unsigned seed) : sizes_(sizes), random_(seed) {}

    /// A law's case with its errors; the tail states the noise.
    SolvedCase with_errors(SolvedCase solved, double mesh_levels, double closure_deviation) {
        DirectionSample& sample = solved.sample;
        LoadEntry& entry = sample.entry;
        const Vector3d force = entry.force;
        const Vector3d moment = entry.moment;
        for (int i = 0; i < 3; ++i) {
            entry.force[i] += sizes_.noise * force.norm() * normal_(random_);
            entry.moment[i] += sizes_.noise * moment.norm() * normal_(random_);
            sample.error.force[i] = sizes_.noise * force.norm();
            sample.error.moment[i] = sizes_.noise * moment.norm();
        }
        entry.force += mesh_levels * sizes_.mesh * force;
        entry.moment += mesh_levels * sizes_.mesh * moment;
        for (double LoadEntry::*scalar :
             {&LoadEntry::turbulent_kinetic_energy, &LoadEntry::dissipation_rate}) {
            sample.error.*scalar = sizes_.noise * entry.*scalar;
            entry.*scalar *=
                std::exp(sizes_.noise * normal_(random_) + mesh_levels * sizes_.mesh + closure_deviation);
        }
        return solved;
    }

    double closure_deviation() { return sizes_.closure * normal_(random_); }

  private:
    CaseErrors sizes_;
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
};

/// Two meshes: the last in the directions of a map with `of_last_mesh` subdivisions, the one before it, twice
/// as wrong, in those of one with `n`. By how much they are wrong depends on the direction.
std::vector<SolvedCase> baked_on_two_meshes(const Symmetry& symmetry, int of_last_mesh, int n, const Law& law,
                                            const CaseErrors& sizes, unsigned seed) {
    Errors errors(sizes, seed);
    const auto mesh_error = [](const Vector3d& d) { return 0.5 + d.x() * d.x() - 0.5 * std::abs(d.z()); };
    std::vector<SolvedCase> cases;
    for (const SolvedCase& solved :
         test::solved_cases(required_directions(symmetry, of_last_mesh), law, 1e4)) {
        cases.push_back(errors.with_errors(solved, mesh_error(solved.sample.direction), 0.0));
    }
    for (const SolvedCase& solved : test::solved_cases(required_directions(symmetry, n), law, 1e4)) {
        cases.push_back(errors.with_errors(solved, 2.0 * mesh_error(solved.sample.direction), 0.0));
        cases.back().purpose = CasePurpose::mesh;
        cases.back().mesh = "mesh_medium";
    }
    return cases;
}

/// A bake: the table's cases on the nodes of a map, coarser meshes and another closure in three of them.
std::vector<SolvedCase> baked(const Symmetry& symmetry, int n, const Law& law, const CaseErrors& sizes,
                              unsigned seed) {
    Errors errors(sizes, seed);
    const double of_table = errors.closure_deviation();
    const double of_other = errors.closure_deviation();
    const std::vector<SolvedCase> exact = test::solved_cases(required_directions(symmetry, n), law, 1e4);
    std::vector<SolvedCase> cases;
    for (const SolvedCase& solved : exact) cases.push_back(errors.with_errors(solved, 1.0, of_table));
    for (std::size_t i = 1; i < exact.size(); i += std::max<std::size_t>(exact.size() / 3, 1)) {
        if (sizes.mesh > 0.0) {
            cases.push_back(errors.with_errors(exact[i], 2.0, of_table));
            cases.back().purpose = CasePurpose::mesh;
            cases.back().mesh = "mesh_coarse";
        }
        if (sizes.closure > 0.0) {
            cases.push_back(errors.with_errors(exact[i], 1.0, of_other));
            cases.back().purpose = CasePurpose::closure;
            cases.back().closure = Closure::realizable_k_epsilon;
        }
    }
    return cases;
}

constexpr std::size_t quantity_count = 4;

/// How the true errors of looked-up values compare with the stated ones, for force, moment, k and epsilon.
struct Coverage {
    std::array<double, quantity_count> within{};  ///< share of values within two standard errors
    std::array<double, quantity_count> ratio{};   ///< rms of the stated over rms of the true errors
};

std::array<std::vector<double>, quantity_count> values_of(const LoadEntry& entry) {
    return {std::vector<double>{entry.force.x(), entry.force.y(), entry.force.z()},
            {entry.moment.x(), entry.moment.y(), entry.moment.z()},
            {entry.turbulent_kinetic_energy},
            {entry.dissipation_rate}};
}

class CoverageCount {
  public:
    void add(const LoadTables& tables, const Law& law) {
        constexpr int count = 200;
        for (int i = 0; i < count; ++i) {
            const Vector3d direction = test::spiral_direction(i, count);
            const auto errors = values_of(plus(look_up(tables, direction, 1e4), -1.0, law(direction)));
            const auto stated = values_of(look_up_error(tables, direction, 1e4));
            for (std::size_t q = 0; q < quantity_count; ++q) {
                for (std::size_t c = 0; c < errors[q].size(); ++c) {
                    within_[q] += std::abs(errors[q][c]) <= 2.0 * stated[q][c] ? 1.0 : 0.0;
                    true_squares_[q] += errors[q][c] * errors[q][c];
                    stated_squares_[q] += stated[q][c] * stated[q][c];
                    values_[q] += 1.0;
                }
            }
        }
    }
    [[nodiscard]] Coverage result() const {
        Coverage coverage;
        for (std::size_t q = 0; q < quantity_count; ++q) {
            coverage.within[q] = within_[q] / values_[q];
            coverage.ratio[q] = std::sqrt(stated_squares_[q] / true_squares_[q]);
        }
        return coverage;
    }

  private:
    std::array<double, quantity_count> within_{};
    std::array<double, quantity_count> true_squares_{};
    std::array<double, quantity_count> stated_squares_{};
    std::array<double, quantity_count> values_{};
};

struct Bake {
    Symmetry symmetry;
    Law law;
    int subdivisions;
    int stored;
    CaseErrors errors;
    int of_last_mesh = 0;  ///< subdivisions of the map that it is solved on, where the one before has more
};

Coverage coverage_of(const Bake& bake, unsigned seeds) {
    CoverageCount count;
    for (unsigned seed = 0; seed < seeds; ++seed) {
        std::vector<SolvedCase> cases =
            bake.of_last_mesh > 0 ? baked_on_two_meshes(bake.symmetry, bake.of_last_mesh, bake.subdivisions,
                                                        bake.law, bake.errors, seed)
                                  : baked(bake.symmetry, bake.subdivisions, bake.law, bake.errors, seed);
        count.add(test::filled(bake.symmetry, bake.stored, cases), bake.law);
    }
    return count.result();
}

/// The law of a bluff ellipsoid: its wake detaches between edge-on and broadside, where the force has a
/// kink, and k rises.
LoadEntry ellipsoid_law(const Vector3d& d) {
    const double broadside = std::abs(d.x());
    const double detached = std::max(0.0, broadside - 0.5);
    LoadEntry entry;
    entry.force = -Vector3d(1.35, 0.26, 0.09).cwiseProduct(d) - 0.4 * detached * d;
    entry.force.x() -= 0.25 * std::copysign(std::min(broadside, 0.45), d.x());
    entry.moment =
        (1.0 + 0.8 * std::max(0.0, 0.6 - broadside)) * d.cross(Vector3d(0.0, 0.2, 0.35).cwiseProduct(d));
    entry.turbulent_kinetic_energy =
        0.0005 + 0.002 * broadside + 0.01 * broadside * std::max(0.0, broadside - 0.6);
    entry.dissipation_rate = 0.7 * entry.turbulent_kinetic_energy;
    return entry;
}

/// The law of a thin plate across x: the force stays on its normal and stalls at 15 degrees, with the centre
/// of pressure moving from a quarter of the chord to the middle.
LoadEntry plate_law(const Vector3d& d) {
    const double incidence = std::asin(std::min(1.0, std::abs(d.x())));
    const double stall = 0.26;
    const double slope = 4.0;
    const double normal = incidence < stall
                              ? slope * incidence
                              : 0.88 + 0.32 * (incidence - stall) / (std::numbers::pi / 2.0 - stall);
    LoadEntry entry;
    entry.force = Vector3d(-std::copysign(normal, d.x()), -0.05 * d.y(), -0.05 * d.z());
    const Vector3d along(0.0, d.y(), d.z());
    if (along.norm() > 1e-12) {
        const double arm = 0.25 * (1.0 - 2.0 * incidence / std::numbers::pi);
        entry.moment = arm * along.normalized().cross(Vector3d(entry.force.x(), 0.0, 0.0));
    }
    entry.turbulent_kinetic_energy = 0.001 + 0.01 / (1.0 + std::exp(-(incidence - 0.4) / 0.1));
    entry.dissipation_rate = 0.5 * entry.turbulent_kinetic_energy;
    return entry;
}

/// A cone: beyond 20 degrees its lee side stalls, beyond 70 the flow is detached all round.
LoadEntry cone_law(const Vector3d& d) {
    const double cosine = d.x();
    const double sine = std::hypot(d.y(), d.z());
    const double attached = std::min(sine, 0.34);
    const double detached = std::max(0.0, cosine - 0.34);
    LoadEntry entry;
    entry.force = -(0.8 + 0.5 * detached) * d - 0.3 * cosine * Vector3d::UnitX();
    entry.moment = (0.6 * attached * cosine - 0.2 * detached * sine + 0.1 * sine) / std::max(sine, 1e-12) *
                   Vector3d::UnitX().cross(d);
    entry.turbulent_kinetic_energy = 0.005 * (1.0 + 3.0 * detached + sine * sine);
    entry.dissipation_rate = 0.7 * entry.turbulent_kinetic_energy;
    return entry;
}

/// Loads without any symmetry.
LoadEntry lump_law(const Vector3d& d) {
    LoadEntry entry = ellipsoid_law((test::some_rotation() * d).eval());
    entry.force += 0.2 * d.x() * Vector3d(0.3, -0.5, 0.8);
    return entry;
}

Symmetry cone_symmetry() {
    Symmetry symmetry;
    symmetry.type = Symmetry::Type::axial;
    symmetry.axis = Vector3d::UnitX();
    return symmetry;
}

/// Nine in ten of all values within two standard errors, which are no wider than `widest` times the true
/// errors.
void expect_honest(const Bake& bake, unsigned seeds, double widest) {
    const Coverage coverage = coverage_of(bake, seeds);
    for (std::size_t q = 0; q < quantity_count; ++q) {
        EXPECT_GE(coverage.within[q], 0.9) << "quantity " << q;
        EXPECT_LT(coverage.ratio[q], widest) << "quantity " << q;
    }
}

// The errors of k and epsilon do not hold the spread of closures.
constexpr CaseErrors all_errors{.noise = 0.02, .mesh = 0.05};

TEST(TableCoverage, OfABluffEllipsoidIsNineInTenBetweenTheNodes) {
    expect_honest({test::box_symmetry(), ellipsoid_law, 3, 9, {}}, 1, 3.0);
    expect_honest({test::box_symmetry(), ellipsoid_law, 4, 8, {}}, 1, 3.0);
    expect_honest({test::box_symmetry(), ellipsoid_law, 4, 4, {}}, 1, 3.0);
    expect_honest({test::box_symmetry(), ellipsoid_law, 4, 8, all_errors}, 30, 3.6);
}

TEST(TableCoverage, OfAStallingPlateIsNineInTenWhereTheNodesSeeTheStall) {
    // k rises in one smooth step there, whose error leaving out nodes overestimates.
    expect_honest({test::box_symmetry(), plate_law, 4, 8, {}}, 1, 8.0);
    expect_honest({test::box_symmetry(), plate_law, 6, 12, {}}, 1, 4.0);
    expect_honest({test::box_symmetry(), plate_law, 4, 8, all_errors}, 30, 3.6);
}

TEST(TableCoverage, OfABodyOfRevolutionIsNineInTen) {
    expect_honest({cone_symmetry(), cone_law, 6, 12, all_errors}, 30, 3.6);
}

TEST(TableCoverage, OfABodyWithoutSymmetryIsNineInTen) {
    expect_honest({Symmetry{}, lump_law, 3, 6, all_errors}, 12, 4.0);
}

TEST(TableCoverage, OfFewDirectionsOnTheLastMeshIsNineInTen) {
    constexpr CaseErrors errors{.noise = 0.02, .mesh = 0.2};
    expect_honest({test::box_symmetry(), ellipsoid_law, 4, 8, errors, 2}, 30, 3.6);
    expect_honest({cone_symmetry(), cone_law, 6, 12, errors, 3}, 30, 3.6);
}

/// Returns the share of one source in a bake with errors of one type; nothing where the tables do not name
/// it.
std::optional<ErrorShare> share_of(ErrorSource source, const CaseErrors& sizes, unsigned seed = 1) {
    std::vector<SolvedCase> cases = baked(test::box_symmetry(), 4, ellipsoid_law, sizes, seed);
    for (const ErrorShare& share : test::filled(test::box_symmetry(), 8, cases).error_sources) {
        if (share.source == source) return share;
    }
    return std::nullopt;
}

TEST(TableErrors, OfTheMeshAreTheDifferenceBetweenTwoMeshes) {
    EXPECT_FALSE(share_of(ErrorSource::mesh, {}));
    const ErrorShare share = share_of(ErrorSource::mesh, {.mesh = 0.05}).value();
    // The whole difference, not widened. A load counts by its components, and is a fraction of
    // sqrt(|F|^2 + (rms F)^2/4), so that large loads carry somewhat less than their own part.
    for (const double value : {share.force, share.moment}) {
        EXPECT_GT(value, 0.05 / std::sqrt(1.25));
        EXPECT_LT(value, 0.05 * std::sqrt(3.0));
    }
    EXPECT_NEAR(share.turbulent_kinetic_energy, std::expm1(0.05), 0.01);
}

TEST(TableErrors, OfTheClosureAreTheirStandardDeviation) {
    EXPECT_FALSE(share_of(ErrorSource::closure, {}));
    // One k for all directions, so that the scale of its root is the same in all.
    const auto law = [](const Vector3d& d) {
        LoadEntry entry = ellipsoid_law(d);
        entry.turbulent_kinetic_energy = entry.dissipation_rate = 0.04;
        return entry;
    };
    std::vector<SolvedCase> cases =
        test::solved_cases(required_directions(test::box_symmetry(), 4), law, 1e4);
    for (const std::size_t i : {std::size_t{1}, std::size_t{6}, std::size_t{11}}) {
        SolvedCase other = cases[i];
        other.purpose = CasePurpose::closure;
        other.closure = Closure::realizable_k_epsilon;
        other.sample.entry.turbulent_kinetic_energy *= 3.0;
        cases.push_back(other);
    }
    const LoadTables tables = test::filled(test::box_symmetry(), 8, cases);
    const auto share = std::ranges::find(tables.error_sources, ErrorSource::closure, &ErrorShare::source);
    ASSERT_NE(share, tables.error_sources.end());
    EXPECT_EQ(share->force, 0.0);
    EXPECT_EQ(share->dissipation_rate, 0.0);
    // t/2 of Student's distribution for three degrees of freedom, GUM (JCGM 100:2008), table G.2, times the
    // deviation of the two roots of k, sqrt(3) - 1 apart.
    const double of_root = 3.307 / 2.0 * (std::sqrt(3.0) - 1.0) / std::sqrt(2.0);
    EXPECT_NEAR(std::sqrt(1.0 + share->turbulent_kinetic_energy) - 1.0, of_root, 1e-3);
    // It is a spread of its own, and in no entry's error (what the interpolation of a constant leaves is
    // the root of its rounding).
    for (const LoadEntryError& error : tables.errors) EXPECT_LT(error.turbulent_kinetic_energy, 1e-6);
}

TEST(TableErrors, OfTheTailAreThoseOfTheCases) {
    const ErrorShare share = share_of(ErrorSource::tail, {.noise = 0.03}).value();
    EXPECT_NEAR(share.turbulent_kinetic_energy, 0.03, 0.003);
    EXPECT_NEAR(share.force, 0.03 * std::sqrt(3.0), 0.008);
    EXPECT_EQ(share_of(ErrorSource::tail, {.mesh = 0.05}).value().force, 0.0);
}

TEST(TableErrors, OfTheSymmetryAreWhatItForbids) {
    EXPECT_EQ(share_of(ErrorSource::symmetry, {.mesh = 0.05}).value().moment, 0.0);
    const ErrorShare share = share_of(ErrorSource::symmetry, {.noise = 0.03}).value();
    EXPECT_GT(share.force, 0.02);
    EXPECT_LT(share.force, 0.1);
    std::vector<SolvedCase> lump = baked(Symmetry{}, 2, lump_law, all_errors, 1);
    for (const ErrorShare& one : test::filled(Symmetry{}, 4, lump).error_sources) {
        EXPECT_NE(one.source, ErrorSource::symmetry);
    }
}

TEST(TableErrors, AreAsWideForALoadThatVanishesAsForHalfTheMeanOne) {
    const LoadScale scale{{2.0, 0.6, 0.6, 0.2}};
    const ErrorMetrics size = scale.at({Vector3d::Zero(), Vector3d(0.0, 0.4, 0.0), 0.4, 0.0});
    EXPECT_EQ(size.force, 1.0);
    EXPECT_EQ(size.moment, 0.5);
    EXPECT_EQ(size.turbulent_kinetic_energy, 0.5);
    EXPECT_EQ(size.dissipation_rate, 0.1);
}

}  // namespace
}  // namespace samara
