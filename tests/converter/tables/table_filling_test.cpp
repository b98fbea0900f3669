#include "converter/tables/table_filling.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "converter/tables/direction_sampling.hpp"
#include "load_laws.hpp"
#include "samara/core/surface/octahedral_map.hpp"
#include "support/expect_error.hpp"
#include "symmetry_groups.hpp"
#include "table_cases.hpp"

namespace samara {
namespace {

using Law = std::function<LoadEntry(const Vector3d&)>;

std::vector<SolvedCase> solve(const Symmetry& symmetry, int n, const Law& law, double reynolds_number = 1e4) {
    return test::solved_cases(required_directions(symmetry, n), law, reynolds_number);
}

/// The tables on a map with `stored` subdivisions, by cases in the directions of one with `n`.
LoadTables filled(const Symmetry& symmetry, int n, const Law& law, int stored) {
    std::vector<SolvedCase> cases = solve(symmetry, n, law);
    return test::filled(symmetry, stored, cases);
}

/// The largest difference from the law over all nodes of the stored map.
double largest_error(const Symmetry& symmetry, int n, const Law& law, int stored) {
    const LoadTables map = filled(symmetry, n, law, stored);
    double largest = 0.0;
    std::size_t node = 0;
    for (const Vector3d& direction : octahedral_nodes(stored)) {
        const LoadEntry found = transformed(map.entries.at(node++), map.axes.transpose());
        largest = std::max(largest, test::difference(found, law(direction)));
    }
    return largest;
}

double largest_error(const Symmetry& symmetry, int n, const Law& law) {
    return largest_error(symmetry, n, law, n);
}

Symmetry axial(int column, bool mirrored) {
    Symmetry symmetry;
    symmetry.type = Symmetry::Type::axial;
    symmetry.axis = Vector3d::Unit(column);
    if (mirrored) {
        symmetry.elements.emplace_back(Matrix3d::Identity() -
                                       2.0 * symmetry.axis * symmetry.axis.transpose());
    }
    return symmetry;
}

TEST(FilledMap, IsExactForABox) {
    for (const int n : {1, 2, 3, 6}) {
        EXPECT_LT(largest_error(test::box_symmetry(), n, test::BoxLaw{}), 1e-14);
    }
}

TEST(FilledMap, IsExactForASquarePrism) {
    const test::BoxLaw law{Vector3d(0.6, 0.6, 1.9), Vector3d(0.3, 0.3, 0.5)};
    const auto turbulence_too = [&](const Vector3d& d) {
        LoadEntry entry = law(d);
        entry.turbulent_kinetic_energy = entry.dissipation_rate = 0.01 + 0.002 * d.z() * d.z();
        return entry;
    };
    EXPECT_LT(largest_error(test::square_prism_symmetry(), 4, turbulence_too), 1e-14);
}

TEST(FilledMap, IsExactInTurnedShapeAxes) {
    const Matrix3d rotation = test::some_rotation();
    EXPECT_LT(largest_error(test::turned(test::box_symmetry(), rotation), 4, test::BoxLaw{}), 1e-14);
}

TEST(FilledMap, IsExactForABodyOfOneMirrorAndForOneOfNone) {
    const Vector3d skewed(0.2, 0.0, 0.1);
    const auto law = [&](const Vector3d& d) {
        LoadEntry entry = test::BoxLaw{}(d);
        entry.force += 0.3 * skewed.cross(d).norm() * skewed;
        entry.moment += skewed.cross(d);
        return entry;
    };
    EXPECT_LT(largest_error(test::generated_by({Vector3d(1, -1, 1).asDiagonal()}), 4, law), 1e-14);
    EXPECT_LT(largest_error(Symmetry{}, 4, law), 1e-14);
}

TEST(FilledMap, IsExactForAPropellerOfFiveBlades) {
    const double fifth = 2.0 * std::numbers::pi / 5.0;
    const Symmetry symmetry =
        test::generated_by({Eigen::AngleAxisd(fifth, Vector3d::UnitZ()).toRotationMatrix()});
    const auto law = [](const Vector3d& d) {
        LoadEntry entry = test::AxialLaw{Vector3d::UnitZ(), 0.5}(d);
        entry.moment += 0.2 * d.z() * Vector3d::UnitZ();  // it turns in the wind
        entry.dissipation_rate += 0.001 * std::cos(5.0 * std::atan2(d.y(), d.x())) * (1.0 - d.z() * d.z());
        return entry;
    };
    EXPECT_LT(largest_error(symmetry, 3, law), 1e-14);
}

TEST(FilledMap, HasEqualEntriesAtTheSeam) {
    constexpr int n = 4;
    constexpr std::size_t size = 2 * n + 1;
    for (const Symmetry& symmetry : {test::box_symmetry(), Symmetry{}, axial(0, true), axial(2, false)}) {
        std::vector<SolvedCase> cases = solve(symmetry, n, test::BoxLaw{});
        for (SolvedCase& solved : cases) solved.sample.error.force = solved.sample.direction.cwiseAbs();
        const LoadTables map = test::filled(symmetry, n, cases);
        for (std::size_t i = 0; i < size; ++i) {
            for (const std::size_t edge : {std::size_t{0}, size - 1}) {
                const std::size_t here = edge * size + i;
                const std::size_t twin = edge * size + (size - 1 - i);
                EXPECT_EQ(test::difference(map.entries[here], map.entries[twin]), 0.0);
                EXPECT_EQ(map.errors[here].force, map.errors[twin].force);
                EXPECT_EQ(
                    test::difference(map.entries[i * size + edge], map.entries[(size - 1 - i) * size + edge]),
                    0.0);
            }
        }
    }
}

TEST(FilledMap, OfABodyOfRevolutionConvergesWithSecondOrderOrBetter) {
    for (const bool mirrored : {true, false}) {
        for (int column = 0; column < 3; ++column) {
            const Symmetry symmetry = axial(column, mirrored);
            const test::AxialLaw law{symmetry.axis, mirrored ? 0.0 : 1.0};
            const double coarse = largest_error(symmetry, 6, law);
            const double fine = largest_error(symmetry, 24, law);
            const double order = std::log(coarse / fine) / std::log(4.0);
            EXPECT_LT(coarse, 0.05);
            EXPECT_GT(order, 1.9) << "column " << column << ", mirrored " << mirrored;
        }
    }
}

TEST(FilledMap, OfABodyOfRevolutionIsExactAtTheAxisAndBroadside) {
    for (const bool mirrored : {true, false}) {
        const Symmetry symmetry = axial(0, mirrored);
        const test::AxialLaw law{symmetry.axis, mirrored ? 0.0 : 1.0};
        constexpr int n = 3;
        const LoadTables map = filled(symmetry, n, law, n);
        for (const auto& [row, column] : {std::pair{3, 6}, {3, 0}, {3, 3}, {6, 3}, {0, 3}, {0, 0}}) {
            const LoadEntry exact = law(octahedral_node(n, row, column));
            const auto node = static_cast<std::size_t>(row) * (2 * n + 1) + static_cast<std::size_t>(column);
            EXPECT_LT(test::difference(map.entries[node], exact), 1e-14);
        }
    }
}

TEST(FilledMap, OfABodyOfRevolutionNeverOvershootsItsSamples) {
    const Symmetry symmetry = axial(2, false);
    constexpr int n = 3;
    std::vector<SolvedCase> cases = solve(symmetry, n, test::AxialLaw{symmetry.axis, 1.0});
    for (std::size_t i = 0; i < cases.size(); ++i) {
        // A jump, as where the wake detaches.
        cases[i].sample.entry.turbulent_kinetic_energy = i < 3 ? 1e-6 : 1.0;
    }
    for (const LoadEntry& entry : test::filled(symmetry, 2 * n, cases).entries) {
        EXPECT_GE(entry.turbulent_kinetic_energy, 1e-6 * (1.0 - 1e-12));
        EXPECT_LE(entry.turbulent_kinetic_energy, 1.0 + 1e-12);
    }
}

TEST(FilledMap, OfASphereIsTheSameDragEverywhere) {
    Symmetry sphere;
    sphere.type = Symmetry::Type::spherical;
    const auto law = [](const Vector3d& d) { return LoadEntry{-0.47 * d, Vector3d::Zero(), 0.01, 0.02}; };
    EXPECT_LT(largest_error(sphere, 4, law), 1e-15);
}

TEST(FilledMap, PassesThroughTheCasesOfACoarserMap) {
    for (const Symmetry& symmetry : {test::box_symmetry(), Symmetry{}}) {
        const LoadTables map = filled(symmetry, 2, test::BoxLaw{}, 6);
        for (int row = 0; row <= 12; row += 3) {
            for (int column = 0; column <= 12; column += 3) {
                const LoadEntry& entry = map.entries[map.index(0, row, column)];
                EXPECT_LT(test::difference(entry, test::BoxLaw{}(octahedral_node(6, row, column))), 1e-13);
            }
        }
    }
}

TEST(FilledMap, OfABodyOfRevolutionPassesThroughTheCasesOfACoarserArc) {
    const Symmetry symmetry = axial(0, true);
    const test::AxialLaw law{symmetry.axis};
    const LoadTables map = filled(symmetry, 2, law, 8);
    for (const Vector3d& direction : required_directions(symmetry, 2)) {
        EXPECT_LT(test::difference(look_up(map, direction, 1e4), law(direction)), 1e-13);
    }
}

/// Far from the directions' polynomials, and smooth.
LoadEntry wavy_law(const Vector3d& d) {
    LoadEntry entry = test::BoxLaw{}(d);
    entry.force *= 1.0 + 0.3 * std::cos(3.0 * d.z() * d.z());
    entry.moment *= std::exp(0.5 * d.x() * d.x());
    return entry;
}

TEST(FilledMap, ConvergesToASmoothLawWithSecondOrderOrBetter) {
    for (const Symmetry& symmetry : {test::box_symmetry(), Symmetry{}}) {
        const double coarse = largest_error(symmetry, 2, wavy_law, 16);
        const double fine = largest_error(symmetry, 8, wavy_law, 16);
        EXPECT_LT(coarse, 0.5);
        EXPECT_GT(std::log(coarse / fine) / std::log(4.0), 1.9);
    }
}

/// The root mean square difference of looked-up force and moment from the law, over many directions.
double lookup_error(const LoadTables& tables, const Law& law) {
    double squares = 0.0;
    constexpr int count = 400;
    for (int i = 0; i < count; ++i) {
        const Vector3d direction = test::spiral_direction(i, count);
        const LoadEntry error = plus(look_up(tables, direction, 1e4), -1.0, law(direction));
        squares += error.force.squaredNorm() + error.moment.squaredNorm();
    }
    return std::sqrt(squares / count);
}

TEST(FilledMap, OfAFinerMapThanWasSolvedIsNearerToTheLawThanABilinearLookup) {
    const Symmetry box = test::box_symmetry();
    EXPECT_LT(lookup_error(filled(box, 4, wavy_law, 16), wavy_law),
              0.4 * lookup_error(filled(box, 4, wavy_law, 4), wavy_law));
}

/// wavy_law on the mesh before the last, which has a tenth to a fifth too much of everything.
LoadEntry law_on_mesh_before(const Vector3d& d) {
    LoadEntry entry = wavy_law(d);
    const double more = 1.1 + 0.1 * d.x() * d.x();
    entry.force *= more;
    entry.moment *= more;
    entry.turbulent_kinetic_energy *= more;
    entry.dissipation_rate *= more;
    return entry;
}

/// The last mesh in the directions of a map with `n` subdivisions, the one before it in those of 4.
std::vector<SolvedCase> solved_on_two_meshes(const Symmetry& symmetry, int n) {
    std::vector<SolvedCase> cases = solve(symmetry, n, wavy_law);
    for (SolvedCase solved : solve(symmetry, 4, law_on_mesh_before)) {
        solved.purpose = CasePurpose::mesh;
        solved.mesh = "mesh_medium";
        cases.push_back(solved);
    }
    return cases;
}

TEST(FilledMap, OfFewDirectionsOnTheLastMeshHasTheShapeOfTheMeshBefore) {
    for (const Symmetry& symmetry : {test::box_symmetry(), Symmetry{}}) {
        const LoadTables everywhere = filled(symmetry, 4, wavy_law, 16);
        const LoadTables alone = filled(symmetry, 2, wavy_law, 16);
        std::vector<SolvedCase> cases = solved_on_two_meshes(symmetry, 2);
        const LoadTables few = test::filled(symmetry, 16, cases);
        EXPECT_LT(lookup_error(few, wavy_law), 1.5 * lookup_error(everywhere, wavy_law));
        EXPECT_LT(lookup_error(few, wavy_law), lookup_error(alone, wavy_law) / 3.0);
        for (const Vector3d& direction : required_directions(symmetry, 2)) {
            EXPECT_LT(test::difference(look_up(few, direction, 1e4), wavy_law(direction)), 1e-13);
        }
    }
}

/// Few directions of a law with steep changes, without that of `failed` on the mesh before.
LoadTables without_on_mesh_before(const Vector3d& failed) {
    std::vector<SolvedCase> cases = solve(Symmetry{}, 1, wavy_law);
    for (SolvedCase solved : solve(Symmetry{}, 2, wavy_law)) {
        solved.purpose = CasePurpose::mesh;
        solved.mesh = "mesh_medium";
        if ((solved.sample.direction - failed).norm() > 1e-9) cases.push_back(solved);
    }
    return test::filled(Symmetry{}, 16, cases);
}

TEST(FilledMap, TakesWhatIsMissedInADirectionThatFailedOnTheMeshBeforeForNoChangeByTheMesh) {
    // Both meshes agree here, so that there is no change to carry elsewhere.
    const LoadTables whole = filled(Symmetry{}, 2, wavy_law, 16);
    for (const Vector3d& failed : required_directions(Symmetry{}, 1)) {
        const LoadTables few = without_on_mesh_before(failed);
        for (std::size_t node = 0; node < few.entries.size(); ++node) {
            EXPECT_LT(test::difference(few.entries[node], whole.entries[node]), 1e-10);
        }
    }
}

TEST(FilledMap, OfAFurtherReynoldsNumberHasTheChangeOfTheLastMeshEverywhere) {
    const Symmetry box = test::box_symmetry();
    const auto slower = [](const Vector3d& d) {
        LoadEntry entry = law_on_mesh_before(d);
        entry.force *= 1.3;
        return entry;
    };
    std::vector<SolvedCase> cases = solved_on_two_meshes(box, 1);
    for (SolvedCase solved : solve(box, 2, slower, 1e3)) {
        solved.mesh = "mesh_medium";
        cases.push_back(solved);
    }
    const LoadTables map = test::filled(box, 8, cases);
    for (const Vector3d& direction : required_directions(box, 2)) {
        const Vector3d changed = look_up(map, direction, 1e3).force - look_up(map, direction, 1e4).force;
        EXPECT_LT((changed - 0.3 * law_on_mesh_before(direction).force).norm(), 1e-13);
    }
}

TEST(FilledMap, HasTheBodysSymmetryBetweenTheCases) {
    const Symmetry cube = test::cube_symmetry();
    const Law law = [](const Vector3d& d) {
        const Vector3d cubes = d.array().cube();
        return LoadEntry{-d - 0.5 * cubes, d.cross(cubes), 0.01 + 0.02 * cubes.cwiseAbs().sum(), 0.02};
    };
    const LoadTables map = filled(cube, 2, law, 6);
    for (int row = 0; row <= 12; ++row) {
        for (int column = 0; column <= 12; ++column) {
            const Vector3d node = octahedral_node(6, row, column);
            const LoadEntry& entry = map.entries[map.index(0, row, column)];
            for (const Matrix3d& element : cube.elements) {
                const LoadEntry image = look_up(map, element * node, 1e4);
                EXPECT_LT(test::difference(image, transformed(entry, element)), 1e-9);
            }
        }
    }
}

TEST(FilledMap, KeepsTurbulencePositiveAndLaminarFlowWithoutAny) {
    const auto steep = [](const Vector3d& d) {
        LoadEntry entry = test::BoxLaw{}(d);
        entry.turbulent_kinetic_energy = std::exp(-8.0 * d.x() * d.x());
        return entry;
    };
    for (const LoadEntry& entry : filled(test::box_symmetry(), 2, steep, 8).entries) {
        EXPECT_GT(entry.turbulent_kinetic_energy, 0.0);
    }
    const auto laminar = [](const Vector3d& d) {
        const LoadEntry entry = test::BoxLaw{}(d);
        return LoadEntry{entry.force, entry.moment, 0.0, 0.0};
    };
    const LoadTables map = filled(test::box_symmetry(), 2, laminar, 4);
    for (std::size_t i = 0; i < map.entries.size(); ++i) {
        EXPECT_EQ(map.entries[i].turbulent_kinetic_energy, 0.0);
        EXPECT_EQ(map.errors[i].turbulent_kinetic_energy, 0.0);
        EXPECT_GT(map.errors[i].force.norm(), 0.0);
    }
}

TEST(FilledMap, RefusesAMixtureOfLaminarAndTurbulentCases) {
    std::vector<SolvedCase> cases = solve(test::box_symmetry(), 2, test::BoxLaw{});
    cases[1].sample.entry.turbulent_kinetic_energy = 0.0;
    EXPECT_EQ(test::error_of([&] { test::filled(test::box_symmetry(), 2, cases); }),
              "Reynolds number 10000: laminar and turbulent cases are mixed");
}

TEST(FilledMap, OfAnotherReynoldsNumberNeedsFewDirections) {
    const Symmetry box = test::box_symmetry();
    const auto slower = [](const Vector3d& d) {
        LoadEntry entry = wavy_law(d);
        entry.force *= 1.3;
        entry.turbulent_kinetic_energy *= 0.5;
        return entry;
    };
    std::vector<SolvedCase> cases = solve(box, 4, wavy_law, 1e4);
    for (const SolvedCase& solved : solve(box, 2, slower, 1e3)) cases.push_back(solved);
    const LoadTables map = test::filled(box, 4, cases);
    EXPECT_EQ(map.reynolds_numbers, (std::vector<double>{1e3, 1e4}));
    double largest = 0.0;
    for (int row = 0; row <= 8; ++row) {
        for (int column = 0; column <= 8; ++column) {
            const Vector3d node = octahedral_node(4, row, column);
            EXPECT_LT(test::difference(map.entries[map.index(1, row, column)], wavy_law(node)), 1e-13);
            const LoadEntry& found = map.entries[map.index(0, row, column)];
            EXPECT_NEAR(found.turbulent_kinetic_energy, slower(node).turbulent_kinetic_energy, 1e-4);
            largest = std::max(largest, (found.force - slower(node).force).norm());
        }
    }
    EXPECT_LT(largest, 0.08);  // of differences of up to 0.7
}

TEST(FilledMap, OfTheFewestDirectionsHasErrorsThatAreFiniteAndNotSmall) {
    for (const Symmetry& symmetry : {test::box_symmetry(), test::cube_symmetry(), Symmetry()}) {
        auto cases = test::solved_cases(required_directions(symmetry, 1), test::BoxLaw(), 1e4);
        const LoadTables tables = test::filled(symmetry, 4, cases);
        double force = 0.0;
        for (const LoadEntryError& error : tables.errors) {
            EXPECT_TRUE(error.force.allFinite() && error.moment.allFinite());
            EXPECT_TRUE(std::isfinite(error.turbulent_kinetic_energy));
            force = std::max(force, error.force.norm());
        }
        EXPECT_GT(force, 0.1);
    }
}

TEST(FilledMap, FillsACaseThatIsMissingFromTheOthersWithAWiderError) {
    const Symmetry box = test::box_symmetry();
    const LoadTables whole = filled(box, 4, wavy_law, 16);
    std::vector<SolvedCase> cases = solve(box, 4, wavy_law);
    const Vector3d lost = cases[3].sample.direction;
    cases.erase(cases.begin() + 3);
    const LoadTables map = test::filled(box, 16, cases);
    const LoadEntry error = plus(look_up(map, lost, 1e4), -1.0, wavy_law(lost));
    const LoadEntryError stated = look_up_error(map, lost, 1e4);
    EXPECT_GT(error.force.norm(), 1e-6);
    EXPECT_LT(error.force.norm(), 0.1);
    EXPECT_LT(error.force.cwiseAbs().maxCoeff(), 2.0 * stated.force.maxCoeff());
    EXPECT_GT(stated.force.x(), 1.3 * look_up_error(whole, lost, 1e4).force.x());
}

}  // namespace
}  // namespace samara
