#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "samara/core/kernel/kernel_single.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again for each target.
#include <hwy/highway.h>

#include "samara/core/kernel/blocks-inl.h"
#include "samara/core/kernel/kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {

BatchReport advance_single_blocks(const StepConstantsIn<float>& constants, const kernel::BlockSteps& steps,
                                  StateBlock* blocks, std::size_t count) {
    return advance_all(constants, steps, blocks, count);
}

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace samara {
namespace {

float single(double number) {
    return static_cast<float>(number);
}
Triple<float> single(const Triple<double>& a) {
    return {single(a.x), single(a.y), single(a.z)};
}
Square<float> single(const Square<double>& a) {
    return {single(a.x), single(a.y), single(a.z)};
}
std::vector<float> single(const std::vector<double>& numbers) {
    std::vector<float> result;
    result.reserve(numbers.size());
    for (const double number : numbers) result.push_back(single(number));
    return result;
}
DirectionTable<float> single(const DirectionTable<double>& table) {
    DirectionTable<float> result{table.width,
                                 table.side,
                                 table.rotated,
                                 single(table.to_map_axes),
                                 single(table.reynolds_numbers),
                                 single(table.logarithms),
                                 single(table.inverse_differences),
                                 {}};
    for (const FourNumbers<double>& row : table.rows) {
        const double* n = row.numbers;
        result.rows.push_back({single(n[0]), single(n[1]), single(n[2]), single(n[3])});
    }
    return result;
}

}  // namespace

HWY_EXPORT(advance_single_blocks);

BatchReport kernel::advance_blocks(const StepConstantsIn<float>& constants, const BlockSteps& steps,
                                   StateBlock* blocks, std::size_t count) noexcept {
    return HWY_DYNAMIC_DISPATCH(advance_single_blocks)(constants, steps, blocks, count);
}

StepConstantsIn<float> in_single(const StepConstants& c) {
    StepConstantsIn<float> result{.length = single(c.length),
                                  .inverse_length = single(c.inverse_length),
                                  .inverse_eddy_length = single(c.inverse_eddy_length),
                                  .mass_scale = single(c.mass_scale),
                                  .off_center = c.off_center,
                                  .coupled = c.coupled,
                                  .center_of_buoyancy = single(c.center_of_buoyancy),
                                  .inertia_angular = single(c.inertia_angular),
                                  .inertia_coupling = single(c.inertia_coupling),
                                  .directed_inertia = single(c.directed_inertia),
                                  .inverse_angular = single(c.inverse_angular),
                                  .inverse_linear = single(c.inverse_linear),
                                  .weight = single(c.weight),
                                  .weight_moment = single(c.weight_moment),
                                  .keeps_thickness = c.keeps_thickness,
                                  .own_mass = single(c.own_mass),
                                  .own_angular = single(c.own_angular),
                                  .own_coupling = single(c.own_coupling),
                                  .tip_square = single(c.tip_square),
                                  .munk_rate = single(c.munk_rate),
                                  .loads = c.loads,
                                  .steady_factor = single(c.steady_factor),
                                  .reynolds_factor = single(c.reynolds_factor),
                                  .loads_by_direction = single(c.loads_by_direction),
                                  .patches = {},
                                  .drag_coefficient = single(c.drag_coefficient),
                                  .twice_lift_coefficient = single(c.twice_lift_coefficient),
                                  .normal = single(c.normal),
                                  .center_of_pressure = single(c.center_of_pressure),
                                  .wake_forms = c.wake_forms,
                                  .squared_formation_length = single(c.squared_formation_length),
                                  .settling_over_formation = single(c.settling_over_formation),
                                  .has_spin_about_symmetry = c.has_spin_about_symmetry,
                                  .spin_about_symmetry = single(c.spin_about_symmetry),
                                  .potential_transport = single(c.potential_transport),
                                  .directed_transport = single(c.directed_transport),
                                  .isotropic_transport = single(c.isotropic_transport),
                                  .spin_lift_onset = single(c.spin_lift_onset),
                                  .transports_rotation = c.transports_rotation,
                                  .transport_of_rotation = single(c.transport_of_rotation),
                                  .coupling_transport = single(c.coupling_transport),
                                  .drag_in_motion = single(c.drag_in_motion),
                                  .rotational_drag = single(c.rotational_drag),
                                  .laminar_rotation = single(c.laminar_rotation),
                                  .has_roll_drag = c.has_roll_drag,
                                  .lacking_roll_drag = single(c.lacking_roll_drag),
                                  .has_side_pressure = c.has_side_pressure,
                                  .side_pressure = single(c.side_pressure),
                                  .has_spin = c.has_spin,
                                  .drag_in_spin = single(c.drag_in_spin),
                                  .rotational_drag_in_spin = single(c.rotational_drag_in_spin),
                                  .half_length = single(c.half_length),
                                  .creeping_rotation = single(c.creeping_rotation),
                                  .creeping_drag = single(c.creeping_drag),
                                  .creeping_fades = single(c.creeping_fades),
                                  .turbulence = c.turbulence,
                                  .langevin = c.langevin,
                                  .turbulence_by_direction = single(c.turbulence_by_direction),
                                  .turbulent_kinetic_energy = single(c.turbulent_kinetic_energy),
                                  .dissipation_rate = single(c.dissipation_rate),
                                  .wake_noise = c.wake_noise};
    for (const LoadPatch<double>& patch : c.patches) {
        result.patches.push_back({single(patch.place), single(patch.share), single(patch.force)});
    }
    return result;
}

}  // namespace samara
#endif
