#pragma once

#include <string>
#include <vector>

#include "samara/core/body/body.hpp"

namespace samara {

/// A plane of two principal axes, in which the direction of motion varies.
struct BodyArc {
    std::string name;  ///< "short to long"
    Vector3d from;     ///< unit vector at angle 0, body axes
    Vector3d to;       ///< at 90 degrees

    [[nodiscard]] Vector3d direction(double angle) const;  ///< unit vector at the angle (rad)
    [[nodiscard]] Vector3d across(double angle) const;     ///< its derivative by the angle
    [[nodiscard]] Vector3d normal() const { return from.cross(to); }
};

/// Values of the tables in one direction of an arc: coefficients on rho U^2 A/2 (moment: times L), and k /
/// U^2.
struct ArcValues {
    double drag;    ///< force against the motion
    double lift;    ///< force towards growing angles
    double moment;  ///< about the arc's normal
    double k;

    /// Returns the largest difference of drag, lift and moment; of lift and moment the sizes are compared.
    [[nodiscard]] double largest_difference(const ArcValues& other) const;
};

/// Returns the tables' values at an angle (rad).
ArcValues values_on(const LoadTables& tables, const BodyArc& arc, double angle, double reynolds_number);
/// Returns the standard errors of values_on(); all zero where the tables hold no errors.
ArcValues errors_on(const LoadTables& tables, const BodyArc& arc, double angle, double reynolds_number);

/// Returns the body's arcs, up to three: one whose loads are another's, to 3 % of the largest force, is left
/// out. The body has tables.
std::vector<BodyArc> arcs_of(const Body& body, double reynolds_number);

/// Returns the angle (degrees) after which the body's symmetry repeats the drag on the arcs: 90, 180 or 360.
double shown_angle(const LoadTables& tables, const std::vector<BodyArc>& arcs, double reynolds_number);

/// Returns the angles (degrees, from 0 to `most`) at which a case's direction, or one that the body's
/// symmetry makes alike, lies on the arc.
std::vector<double> angles_on(const BodyArc& arc, const Symmetry& symmetry, const Vector3d& direction,
                              double most);

}  // namespace samara
