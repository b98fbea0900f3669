#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "converter/tables/table_filling.hpp"

namespace samara::test {

/// Cases for the table that follow a law (map axes) without any error.
inline std::vector<SolvedCase> solved_cases(const std::vector<Vector3d>& directions,
                                            const std::function<LoadEntry(const Vector3d&)>& law,
                                            double reynolds_number) {
    std::vector<SolvedCase> cases;
    for (const Vector3d& direction : directions) {
        SolvedCase solved;
        solved.name = "case_" + std::to_string(cases.size());
        solved.reynolds_number = reynolds_number;
        solved.sample = {direction, law(direction), {}};
        cases.push_back(solved);
    }
    return cases;
}

/// Tables on a map with `subdivisions`, filled from the cases.
inline LoadTables filled(const Symmetry& symmetry, int subdivisions, std::vector<SolvedCase>& cases,
                         double main_reynolds_number = 1e4) {
    LoadTables tables;
    tables.reference_length = 1.0;
    tables.subdivisions = subdivisions;
    tables.axes = symmetry.axes;
    fill_tables(tables, symmetry, cases, main_reynolds_number);
    return tables;
}

/// Direction `i` of `count`, evenly spread over the sphere on a spiral.
inline Vector3d spiral_direction(int i, int count) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double radius = std::sqrt(1.0 - z * z);
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

}  // namespace samara::test
