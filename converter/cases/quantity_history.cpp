#include "converter/cases/quantity_history.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"

namespace samara {
namespace {

// What is this far off is no part of a flow that has settled: a value that a damaged file or a diverging
// solver left. Chosen: far beyond any swing of a wake.
constexpr double most_over_median = 10.0;
constexpr double most_over_scatter = 50.0;

double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::size_t first_index(const QuantityHistory& history, double start) {
    const auto first = std::lower_bound(history.times.begin(), history.times.end(), start);
    return static_cast<std::size_t>(first - history.times.begin());
}

bool same_time(double a, double b) {
    return std::abs(a - b) <= 1e-6 * std::abs(b);
}

// Throws where `history` lacks one of the times of `other`.
void require_times_of(const QuantityHistory& other, const QuantityHistory& history, double start,
                      const std::string& remedy) {
    std::size_t i = first_index(history, start);
    for (std::size_t j = first_index(other, start); j < other.times.size(); ++j, ++i) {
        const double time = other.times[j];
        if (i < history.times.size() && same_time(history.times[i], time)) continue;
        // One that is ahead lacks the time; one behind has times that the other lacks, which is found the
        // other way.
        if (i < history.times.size() && history.times[i] < time) return;
        throw Error(fmt::format(
            "{}: has no {} at the time {:.10g}, which {} has: it was emptied, cut short, or its run's "
            "file is missing; {}",
            history.files.at(time).string(), history.name, time, other.files.at(time).string(), remedy));
    }
}

void require_even_steps(const QuantityHistory& history, double start, const std::string& remedy) {
    const std::size_t first = first_index(history, start);
    std::vector<double> steps;
    for (std::size_t i = first + 1; i < history.times.size(); ++i) {
        steps.push_back(history.times[i] - history.times[i - 1]);
    }
    const double usual = median(steps);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (steps[i] <= 2.0 * usual * (1.0 + 1e-6)) continue;
        const double before = history.times[first + i];
        throw Error(fmt::format(
            "{}: has nothing between the times {:.10g} and {:.10g}; a run's file was emptied or is "
            "missing; {}",
            history.files.at(before).string(), before, before + steps[i], remedy));
    }
}

}  // namespace

void require_whole(const std::vector<QuantityHistory>& histories, double start, const std::string& remedy) {
    for (const QuantityHistory& history : histories) {
        for (const QuantityHistory& other : histories) require_times_of(other, history, start, remedy);
    }
    if (!histories.empty()) require_even_steps(histories.front(), start, remedy);
}

void require_plausible(const QuantityHistory& history, double start, const std::string& remedy) {
    const std::size_t first = first_index(history, start);
    const auto reject = [&](std::size_t i, const std::string& why) {
        const double size = history.is_scalar ? history.values[i].x() : history.values[i].norm();
        throw Error(fmt::format(
            "{}: the {} {} {:.4g} at the time {:.10g}, {}; {}", history.files.at(history.times[i]).string(),
            history.name, history.is_scalar ? "is" : "has the size", size, history.times[i], why, remedy));
    };
    Vector3d middle;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> components;
        for (std::size_t i = first; i < history.values.size(); ++i)
            components.push_back(history.values[i][axis]);
        middle[axis] = median(std::move(components));
    }
    std::vector<double> distances;
    for (std::size_t i = first; i < history.values.size(); ++i) {
        distances.push_back((history.values[i] - middle).norm());
    }
    const double scatter = median(distances);
    const double most =
        most_over_median * std::max(middle.norm(), history.noise) + most_over_scatter * scatter;
    for (std::size_t i = first; i < history.values.size(); ++i) {
        if (history.values[i].norm() > history.largest) {
            reject(i, fmt::format("beyond any flow's ({:.4g}): diverged or damaged", history.largest));
        }
        if (history.is_scalar && history.values[i].x() < 0.0)
            reject(i, "which is never negative: diverged or damaged");
        if (distances[i - first] > most) {
            reject(i, fmt::format("far from the others (about {:.4g}): damaged, or not settled",
                                  history.is_scalar ? middle.x() : middle.norm()));
        }
    }
}

}  // namespace samara
