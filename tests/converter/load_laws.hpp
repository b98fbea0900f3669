#pragma once

#include "converter/tables/symmetric_loads.hpp"

namespace samara::test {

/// Loads with the symmetry of a box whose mirrors are the coordinate planes: force -A d, moment d x B d.
struct BoxLaw {
    Vector3d resistance = Vector3d(0.6, 1.1, 1.9);
    Vector3d torque = Vector3d(0.3, -0.2, 0.5);

    [[nodiscard]] LoadEntry operator()(const Vector3d& d) const {
        LoadEntry entry;
        entry.force = -resistance.cwiseProduct(d);
        entry.moment = d.cross(torque.cwiseProduct(d));
        entry.turbulent_kinetic_energy = 0.01 + 0.004 * d.x() * d.x() + 0.002 * d.z() * d.z();
        entry.dissipation_rate = 0.02 + 0.01 * d.y() * d.y();
        return entry;
    }
};

/// Returns the law at any Reynolds number, for SolvedFolder.
inline LoadEntry box_law(const Vector3d& direction, double /*reynolds_number*/) {
    return BoxLaw{}(direction);
}

/// Loads of a body of revolution about `axis`; `taper` makes its two ends differ.
struct AxialLaw {
    Vector3d axis;
    double taper = 0.0;

    [[nodiscard]] LoadEntry operator()(const Vector3d& d) const {
        const double c = axis.dot(d);
        LoadEntry entry;
        entry.force = -(1.2 + 0.5 * taper * c - 0.3 * c * c) * d - (0.4 * c + 0.1 * taper) * axis;
        entry.moment = (0.7 * c + 0.2 * taper) * axis.cross(d);
        entry.turbulent_kinetic_energy = 0.01 + 0.005 * c * c + 0.002 * taper * c;
        entry.dissipation_rate = 0.02 + 0.01 * c * c;
        return entry;
    }
};

inline double difference(const LoadEntry& a, const LoadEntry& b) {
    return (a.force - b.force).norm() + (a.moment - b.moment).norm() +
           std::abs(a.turbulent_kinetic_energy - b.turbulent_kinetic_energy) +
           std::abs(a.dissipation_rate - b.dissipation_rate);
}

}  // namespace samara::test
