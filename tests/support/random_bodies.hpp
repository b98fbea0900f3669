#pragma once

#include <random>

#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/integrator/step.hpp"

namespace samara::test {

/// Random bodies that no shape would give, to search for errors: any positive definite added mass with
/// coupling, densities from a thousandth to a billion times water's, the centre of mass up to two body
/// lengths away, tables that jump from node to node by up to a hundred times (some with drag against the
/// motion that interpolation turns into thrust), coefficients, or no loads; dynamic coefficients of any size
/// and sign, drags positive semidefinite.
class RandomBodies {
  public:
    explicit RandomBodies(unsigned seed) : generator_(seed), wakes_(seed) {}

    ImmersedBody body();
    /// Returns a state with speeds from 1e-4 to 1e3 m/s and rad/s, any orientation, any wake.
    BodyState state();
    /// Returns a number that is logarithmically uniform between the bounds.
    double magnitude(double lowest, double highest);

  private:
    double uniform(double lowest, double highest);
    Vector3d vector();
    /// Returns A A^T of a random matrix, between the condition numbers 1 and about 1e4.
    template <int Size>
    Eigen::Matrix<double, Size, Size> positive_definite();
    /// Returns a positive semidefinite matrix of rank zero, one or three.
    Matrix3d semidefinite(double scale);
    /// Returns a symmetric matrix that is zero or, as a rule, indefinite.
    Matrix3d symmetric(double scale);
    DynamicCoefficients coefficients(double size);
    LoadTables tables(double length);

    std::mt19937_64 generator_;
    std::mt19937_64 wakes_;  // on their own, so that the bodies stay those of before
};

}  // namespace samara::test
