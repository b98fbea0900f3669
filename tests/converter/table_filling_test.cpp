#include "converter/table_filling.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "converter/direction_sampling.hpp"
#include "load_laws.hpp"
#include "samara/base/error.hpp"
#include "samara/body/octahedral_map.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "symmetry_groups.hpp"

namespace samara {
namespace {

using Law = std::function<LoadEntry(const Vector3d&)>;

std::vector<DirectionSample> solve(const Symmetry& symmetry, int n, const Law& law) {
    std::vector<DirectionSample> samples;
    for (const Vector3d& direction : required_directions(symmetry, n)) {
        samples.push_back({direction, law(direction), {}});
    }
    keep_symmetric_part(symmetry, samples);
    return samples;
}

/// The largest difference from the law over all nodes of the map filled from the required directions.
double largest_error(const Symmetry& symmetry, int n, const Law& law) {
    const FilledMap map = fill_map(symmetry, n, solve(symmetry, n, law));
    double largest = 0.0;
    std::size_t node = 0;
    for (int row = 0; row <= 2 * n; ++row) {
        for (int column = 0; column <= 2 * n; ++column) {
            const LoadEntry exact = law(octahedral_node(n, row, column));
            largest = std::max(largest, test::difference(map.entries.at(node++), exact));
        }
    }
    return largest;
}

Symmetry axial(int column, bool mirrored) {
    Symmetry symmetry;
    symmetry.kind = Symmetry::Kind::axial;
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
        std::vector<DirectionSample> samples = solve(symmetry, n, test::BoxLaw{});
        for (DirectionSample& sample : samples) sample.error.force = sample.direction.cwiseAbs();
        const FilledMap map = fill_map(symmetry, n, samples);
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
        const FilledMap map = fill_map(symmetry, n, solve(symmetry, n, law));
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
    std::vector<DirectionSample> samples = solve(symmetry, n, test::AxialLaw{symmetry.axis, 1.0});
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i].entry.turbulent_kinetic_energy = i < 3 ? 1e-6 : 1.0;  // a jump, as where the wake detaches
    }
    for (const LoadEntry& entry : fill_map(symmetry, n, samples).entries) {
        EXPECT_GE(entry.turbulent_kinetic_energy, 1e-6);
        EXPECT_LE(entry.turbulent_kinetic_energy, 1.0);
    }
}

TEST(FilledMap, OfASphereIsTheSameDragEverywhere) {
    Symmetry sphere;
    sphere.kind = Symmetry::Kind::spherical;
    const auto law = [](const Vector3d& d) { return LoadEntry{-0.47 * d, Vector3d::Zero(), 0.01, 0.02}; };
    EXPECT_LT(largest_error(sphere, 4, law), 1e-15);
}

TEST(FilledMap, NamesTheDirectionThatWasNotSolved) {
    std::vector<DirectionSample> samples = solve(test::box_symmetry(), 2, test::BoxLaw{});
    samples.erase(samples.begin());
    const std::string message = test::error_of([&] { fill_map(test::box_symmetry(), 2, samples); });
    EXPECT_EQ(message, "no case in the direction (1, 0, 0), which the table needs");
}

}  // namespace
}  // namespace samara
