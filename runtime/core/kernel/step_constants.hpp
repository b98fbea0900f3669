#pragma once

#include <vector>

#include "samara/core/kernel/triple.hpp"
#include "samara/core/physics/body_physics.hpp"

namespace samara {

/// Numbers of one load instruction, from one cache line.
template <class Real>
struct alignas(4 * sizeof(Real)) FourNumbers {
    Real numbers[4];
};

/// A table over the octahedral map of directions and the logarithm of the Reynolds number (load_tables.hpp),
/// as the step reads it: each node's numbers side by side.
template <class Real>
struct DirectionTable {
    int width = 4;                          ///< numbers a node, a multiple of four
    int side = 3;                           ///< nodes a side of the map
    bool rotated = false;                   ///< whether the map's axes are not the body's
    Square<Real> to_map_axes{};             ///< body axes -> map axes
    std::vector<Real> reynolds_numbers;     ///< ascending
    std::vector<Real> logarithms;           ///< of the Reynolds numbers
    std::vector<Real> inverse_differences;  ///< one over the difference of neighbouring logarithms
    std::vector<FourNumbers<Real>> rows;    ///< ((plane * side + row) * side + column) * width / 4

    [[nodiscard]] int planes() const { return static_cast<int>(logarithms.size()); }
    [[nodiscard]] const Real* numbers() const { return reinterpret_cast<const Real*>(rows.data()); }
};

/// A part of the surface, on which its part of a steady force depends on its own velocity.
template <class Real>
struct LoadPatch {
    Triple<Real> place{};        ///< in units of l, from the middle of all
    Real share = 1;              ///< all add up to one
    DirectionTable<Real> force;  ///< on its own faces; without rows it bears its share of the whole's
};

/// The fluctuation of the loads by a body's own wake, as if the relative velocity fluctuated. Where k is zero
/// the flow is laminar, and does not fluctuate. The pressure of shed vortices also acts on the body's sides:
/// a force across the path of rho |w|/2 times the velocity fluctuation, times the body's projected area in
/// the force's direction, times side_pressure. Measured on bodies that are held (docs/studies/noise).
struct WakeNoise {
    double share = 0.0;                ///< rms of each component over the root of 2k/3
    double side_pressure = 0.0;        ///< of the force on the sides, over rho |w|/2 times the fluctuation
    double rate_by_dissipation = 0.0;  ///< of its renewal, over epsilon/k; 0: the next
    double rate_by_way = 0.0;          ///< likewise, over |w|/L
};

/// By the mean that the tables' k and epsilon are (TurbulenceMean). The eddies of the near wake are smaller
/// than the body, over which they average out; those of the shell hold a small part of the energy.
inline constexpr WakeNoise wake_noise_of_near_wake = {0.14, 1.2, 1.0, 0.0};
inline constexpr WakeNoise wake_noise_of_shell = {0.3, 1.15, 0.0, 1.0 / 2.5};

/// The constants of a body for the step, computed once. Body axes about the centroid; lengths are in units of
/// l (m), the power of two nearest to the body's L, so that they convert without rounding, and masses in
/// units of m*, a third of the trace of K's linear block: all numbers are near one.
template <class Real>
struct StepConstantsIn {
    Real length = 1;                    ///< l (m)
    Real inverse_length = 1;            ///< 1/m
    Real inverse_eddy_length = 1;       ///< 1/L (1/m): the turbulence's rotation is its velocity over L
    Real mass_scale = 1;                ///< m* (kg)
    bool off_center = false;            ///< whether the centre of mass is not the centroid
    bool coupled = false;               ///< whether K has a block of (omega, v) about the centroid
    Triple<Real> center_of_buoyancy{};  ///< m, from the centre of mass to the centroid
    Square<Real> inertia_angular{};     ///< K's block of (omega, omega), over m* l^2
    Square<Real> inertia_coupling{};    ///< of (omega, v), over m* l
    Square<Real> directed_inertia{};    ///< of (v, v), over m*, less the unit matrix: its trace is zero
    Triple<Real> inverse_angular{};     ///< one over the diagonals, for the drag's stiffness
    Triple<Real> inverse_linear{};
    Real weight = 0;               ///< (m - rho_f V) / (m* l): times gravity the force
    Triple<Real> weight_moment{};  ///< m r / (m* l^2), r from the centroid to the centre of mass
    /// Whether the mass grows with the square of the size. Then the next three, of the body alone, count once
    /// more times 1/size - 1.
    bool keeps_thickness = false;
    Real own_mass = 0;            ///< m / m*
    Square<Real> own_angular{};   ///< about the centroid, over m* l^2
    Square<Real> own_coupling{};  ///< over m* l
    Real tip_square = 0;          ///< (L / (2 l))^2
    Real munk_rate = 0;           ///< times the speed: the rate at which the Munk moment rotates the body

    Loads loads = Loads::none;
    Real steady_factor = 0;    ///< rho_f A l / (2 m*)
    Real reynolds_factor = 0;  ///< L l / nu (s)
    /// Force, 0, moment L/l less the patches' part of it, 0; or the area relative to A and zeros.
    DirectionTable<Real> loads_by_direction;
    std::vector<LoadPatch<Real>> patches;  ///< one at least
    Real drag_coefficient = 0;
    Real twice_lift_coefficient = 0;
    Triple<Real> normal{};
    Triple<Real> center_of_pressure{};  ///< in units of l, from the centroid

    bool wake_forms = false;                  ///< whether the loads wait for the wake to form
    Square<Real> squared_formation_length{};  ///< ImmersedBody's, in units of l^2
    Real settling_over_formation = 1;         ///< the distance of formation over that of settling
    bool has_spin_about_symmetry = false;     ///< whether the next is not zero
    Square<Real> spin_about_symmetry{};       ///< ImmersedBody's
    Square<Real> potential_transport{};    ///< rho_f (M - T) / m* over steady_factor, less its isotropic part
    Square<Real> directed_transport{};     ///< rho_f T / m* less its isotropic part
    Real isotropic_transport = 0;          ///< a third of the trace of rho_f T / m*
    Real spin_lift_onset = 0;              ///< b of the isotropic part
    bool transports_rotation = false;      ///< whether the next two are not zero
    Square<Real> transport_of_rotation{};  ///< t rho_f J / (m* l^2)
    Square<Real> coupling_transport{};     ///< t rho_f C / (m* l)
    Square<Real> drag_in_motion{};         ///< rho_f l C_m A / (2 m*)
    Square<Real> rotational_drag{};        ///< rho_f C_w D / (2 m* l)
    /// a sqrt(1000/reynolds_factor): times the root of the combined speed, the laminar part of the last
    Real laminar_rotation = 0;
    bool has_roll_drag = false;        ///< whether the next is not zero
    Square<Real> lacking_roll_drag{};  ///< rho_f R / (2 m* l)
    bool has_side_pressure = false;    ///< whether the next is not zero: of a wake that fluctuates
    Square<Real> side_pressure{};      ///< wake_side_pressure S/A steady_factor, S the projected areas (m^2)
    bool has_spin = false;             ///< whether the next two are not zero
    Square<Real> drag_in_spin{};       ///< rho_f l C_s A / (2 m*)
    Square<Real> rotational_drag_in_spin{};  ///< rho_f C_r D / (2 m* l)
    Real half_length = 0;                    ///< c / l
    Real creeping_rotation = 0;              ///< pi mu L^3 / (m* l^2) (1/s)
    Real creeping_drag = 0;                  ///< 3 pi mu L / m* (1/s); 0 of loads by coefficients
    Real creeping_fades = 0;                 ///< 1/Re at which creeping_drag has faded out; 0: nowhere

    Turbulence turbulence = Turbulence::none;
    Langevin langevin = Langevin::sampled_turbulence;  ///< wake: of tables alone
    DirectionTable<Real> turbulence_by_direction;      ///< k, epsilon l/L, 0, 0
    Real turbulent_kinetic_energy = 0;                 ///< m^2/s^2, where constant
    Real dissipation_rate = 0;                         ///< m^2/s^3, where constant
    WakeNoise wake_noise;
};
using StepConstants = StepConstantsIn<double>;

/// Returns the constants in single precision, for bodies side by side.
StepConstantsIn<float> in_single(const StepConstants& c);

/// A rotating body sheds in phase with its rotation: the rms of the fluctuation is multiplied by w^2 / (w^2 +
/// (wake_order L omega)^2). Chosen by ensembles of falls of two discs (docs/studies/noise).
inline constexpr double wake_order = 4.0;

/// C_k of the paper's eq. 7; Pope, Phys. Fluids 26 (1983).
inline constexpr double kolmogorov_constant = 2.1;

}  // namespace samara
