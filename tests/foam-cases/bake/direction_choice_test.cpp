#include "foam-cases/bake/direction_choice.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../converter/symmetry_groups.hpp"
#include "test_bodies.hpp"

namespace samara {
namespace {

std::vector<FlowVisit> visits_along(const std::vector<Vector3d>& directions) {
    std::vector<FlowVisit> visits;
    for (const Vector3d& direction : directions) visits.push_back({direction.normalized(), 1e4, 1.0});
    return visits;
}

double total(const std::vector<WeightedDirection>& weights) {
    double sum = 0.0;
    for (const WeightedDirection& one : weights) sum += one.weight;
    return sum;
}

/// The weight within some degrees of a direction of the wedge.
double weight_near(const std::vector<WeightedDirection>& weights, const Vector3d& direction) {
    double sum = 0.0;
    for (const WeightedDirection& one : weights) {
        if (one.direction.dot(direction.normalized()) > 0.98) sum += one.weight;
    }
    return sum;
}

Symmetry ball() {
    return test::sphere(0.01).symmetry;
}

Symmetry body_of_revolution() {
    Symmetry symmetry = test::box_symmetry();
    symmetry.type = Symmetry::Type::axial;
    symmetry.axis = Vector3d::UnitZ();
    return symmetry;
}

Symmetry one_mirror() {
    Symmetry symmetry;
    symmetry.elements = {Matrix3d::Identity(), Vector3d(1.0, -1.0, 1.0).asDiagonal().toDenseMatrix()};
    return symmetry;
}

TEST(DirectionWeights, SumToOneForEveryTypeOfSymmetry) {
    const auto visits = visits_along({{1, 2, 3}, {-1, 0.2, 0}, {0, 0, -1}});
    for (const Symmetry& symmetry :
         {Symmetry(), test::box_symmetry(), test::cube_symmetry(), body_of_revolution(), ball()}) {
        EXPECT_NEAR(total(direction_weights(visits, symmetry)), 1.0, 1e-12);
    }
}

TEST(DirectionWeights, LieWhereTheVisitsAreAndALittleEverywhere) {
    const auto weights = direction_weights(visits_along({{1, 2, 3}}), Symmetry());
    EXPECT_GT(weight_near(weights, {1, 2, 3}), 0.95);
    for (const WeightedDirection& one : weights) EXPECT_GT(one.weight, 0.0);
}

TEST(DirectionWeights, AreTheSameForVisitsThatTheSymmetryMakesAlike) {
    const auto of = [](const Vector3d& direction, const Symmetry& symmetry) {
        return direction_weights(visits_along({direction}), symmetry);
    };
    const auto same = [&](const Vector3d& a, const Vector3d& b, const Symmetry& symmetry) {
        const auto first = of(a, symmetry);
        const auto second = of(b, symmetry);
        for (std::size_t i = 0; i < first.size(); ++i) {
            if (std::abs(first[i].weight - second[i].weight) > 1e-12) return false;
        }
        return true;
    };
    EXPECT_TRUE(same({1, 2, 3}, {-1, 2, -3}, test::box_symmetry()));
    EXPECT_TRUE(same({0.6, 0, 0.8}, {0, -0.6, -0.8}, body_of_revolution()));
    EXPECT_TRUE(same({1, 2, 3}, {3, -2, 0}, ball()));
    EXPECT_FALSE(same({1, 2, 3}, {-1, 2, -3}, Symmetry()));
}

TEST(DirectionWeights, CountAVisitByTheSquareOfItsLoads) {
    auto visits = visits_along({{1, 0, 0}, {0, 0, 1}});
    visits[0].pressure = 3.0;
    const auto weights = direction_weights(visits, Symmetry());
    EXPECT_NEAR(weight_near(weights, {1, 0, 0}) / weight_near(weights, {0, 0, 1}), 9.0, 0.2);
}

TEST(VisitedRegion, HoldsTheVisitsAndTheirImagesAlone) {
    const auto region = visited_region(visits_along({{1, 2, 3}}), test::box_symmetry());
    EXPECT_TRUE(region.holds(Vector3d(1, 2, 3).normalized()));
    EXPECT_TRUE(region.holds(Vector3d(-1, -2, 3).normalized()));
    EXPECT_FALSE(region.holds(Vector3d(3, 2, 1).normalized()));
    EXPECT_FALSE(region.holds(Vector3d::UnitX()));
}

TEST(VisitedRegion, OfABallIsEveryDirection) {
    const auto region = visited_region(visits_along({{1, 2, 3}}), ball());
    EXPECT_TRUE(region.holds(Vector3d(3, -2, 1).normalized()));
}

TEST(VisitedRegion, OfABodyOfRevolutionIsABandAroundItsAxis) {
    const auto region = visited_region(visits_along({{0.6, 0.0, 0.8}}), body_of_revolution());
    EXPECT_TRUE(region.holds(Vector3d(0.0, 0.6, 0.8)));
    EXPECT_TRUE(region.holds(Vector3d(-0.6, 0.0, -0.8)));
    EXPECT_FALSE(region.holds(Vector3d(0.0, 0.0, 1.0)));
}

TEST(VisitedRegion, GrowsByAnother) {
    PlannedRegion region = visited_region(visits_along({{1, 0, 0}}), Symmetry());
    merge(region, visited_region(visits_along({{0, 0, 1}}), Symmetry()));
    EXPECT_TRUE(region.holds(Vector3d::UnitX()));
    EXPECT_TRUE(region.holds(Vector3d::UnitZ()));
    EXPECT_FALSE(region.holds(Vector3d::UnitY()));
}

TEST(CandidateDirections, AreAWedgeOfTheFinestMapThatIsAffordable) {
    EXPECT_EQ(candidate_directions(Symmetry()).directions.size(), 66u);
    EXPECT_EQ(candidate_directions(test::box_symmetry()).directions.size(), 45u);
    EXPECT_EQ(candidate_directions(body_of_revolution()).directions.size(), 9u);
    EXPECT_EQ(candidate_directions(ball()).directions.size(), 1u);
}

TEST(EndsOfAxes, AreOneOfEachSetThatTheSymmetryMakesAlike) {
    const auto ends = [](const Symmetry& symmetry) {
        return ends_of_axes(symmetry, candidate_directions(symmetry).directions).size();
    };
    EXPECT_EQ(ends(Symmetry()), 6u);
    EXPECT_EQ(ends(test::box_symmetry()), 3u);
    EXPECT_EQ(ends(test::cube_symmetry()), 1u);
    EXPECT_EQ(ends(ball()), 1u);
}

TEST(ChooseDirections, TakesTheCandidateInTheMiddleOfTheVisitsFirst) {
    const Symmetry box = test::box_symmetry();
    const Candidates candidates = candidate_directions(box);
    const std::vector<std::size_t> axes = ends_of_axes(box, candidates.directions);
    ASSERT_EQ(axes.size(), 3u);
    const auto middle = static_cast<std::size_t>(
        std::ranges::max_element(candidates.directions, {},
                                 [](const Vector3d& d) { return d.dot(Vector3d(1, 1, 1)); }) -
        candidates.directions.begin());
    const auto weights = direction_weights(visits_along({candidates.directions[middle]}), box);
    const auto chosen = choose_directions(box, candidates.directions, axes, weights, 1);
    EXPECT_THAT(chosen, testing::ElementsAre(middle));
}

TEST(ChooseDirections, LowersTheUncertaintyWithEveryDirectionAndRepeatsNone) {
    const Symmetry box = test::box_symmetry();
    const Candidates candidates = candidate_directions(box);
    const auto weights = direction_weights(visits_along({{1, 0.1, 0}, {1, 0.2, 0.1}, {0.8, 0.6, 0}}), box);
    std::vector<std::size_t> chosen = ends_of_axes(box, candidates.directions);
    double before = mean_squared_spread(box, candidates.directions, chosen, weights);
    for (int i = 0; i < 6; ++i) {
        const auto more = choose_directions(box, candidates.directions, chosen, weights, 1);
        ASSERT_EQ(more.size(), 1u);
        EXPECT_EQ(std::ranges::count(chosen, more.front()), 0);
        chosen.push_back(more.front());
        const double left = mean_squared_spread(box, candidates.directions, chosen, weights);
        EXPECT_LT(left, before);
        before = left;
    }
    const auto at_once =
        choose_directions(box, candidates.directions, ends_of_axes(box, candidates.directions), weights, 6);
    EXPECT_TRUE(std::ranges::equal(at_once, std::vector<std::size_t>(chosen.begin() + 3, chosen.end())));
}

TEST(ChooseDirections, FindsNoDirectionThatMakesTheUncertaintyLarger) {
    const Symmetry mirrored = one_mirror();
    const Candidates candidates = candidate_directions(mirrored);
    const auto weights = direction_weights({}, mirrored);
    const std::vector<std::size_t> ends = ends_of_axes(mirrored, candidates.directions);
    const double before = mean_squared_spread(mirrored, candidates.directions, ends, weights);
    for (std::size_t index = 0; index < candidates.directions.size(); ++index) {
        if (std::ranges::count(ends, index) > 0) continue;
        std::vector<std::size_t> more = ends;
        more.push_back(index);
        EXPECT_LT(mean_squared_spread(mirrored, candidates.directions, more, weights), before);
    }
}

TEST(ChooseDirections, LeavesNoHoleAroundABodyWithOneMirror) {
    const Symmetry mirrored = one_mirror();
    const Candidates candidates = candidate_directions(mirrored);
    const auto weights = direction_weights({}, mirrored);
    std::vector<std::size_t> chosen = ends_of_axes(mirrored, candidates.directions);
    const auto more = choose_directions(mirrored, candidates.directions, chosen, weights, 11);
    chosen.insert(chosen.end(), more.begin(), more.end());
    for (const WeightedDirection& here : weights) {
        double nearest = -1.0;
        for (const std::size_t index : chosen) {
            for (const Matrix3d& element : mirrored.elements) {
                nearest = std::max(nearest, here.direction.dot(element * candidates.directions[index]));
            }
        }
        EXPECT_GT(nearest, std::cos(40.0 * std::numbers::pi / 180.0)) << here.direction.transpose();
    }
}

TEST(ChooseDirections, EndsWhereAllAreChosen) {
    const auto weights = direction_weights({}, body_of_revolution());
    const Candidates candidates = candidate_directions(body_of_revolution());
    EXPECT_EQ(choose_directions(body_of_revolution(), candidates.directions, {}, weights, 100).size(), 9u);
}

}  // namespace
}  // namespace samara
