#pragma once

namespace samara {

/// Three numbers: a vector whose components are plain numbers, or as many lanes of them as the machine holds.
template <class Number>
struct Triple {
    Number x, y, z;
};

/// The numbers with a zero, so that one load reads all three.
template <>
struct alignas(32) Triple<double> {
    double x, y, z;
    double none = 0.0;
};

/// A 3x3 matrix by its rows.
template <class Number>
struct Square {
    Triple<Number> x, y, z;
};

}  // namespace samara
