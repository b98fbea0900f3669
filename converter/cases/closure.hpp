#pragma once

#include <string_view>

namespace samara {

/// The model of the turbulence that a case was solved with; OpenFOAM has more than those that are told apart.
enum class Closure {
    unsaid,  ///< the case's plan and provenance say nothing of it
    laminar,
    k_epsilon,
    realizable_k_epsilon,
    rng_k_epsilon,
    launder_sharma_k_epsilon,
    k_omega,
    k_omega_sst,
    k_omega_sst_lm,
    k_omega_sst_ddes,
    spalart_allmaras,
    other
};

/// The closure's word in plan.json, fall.json, provenance.json and the case's parameters, which is
/// OpenFOAM's: kEpsilon, ...; "other" for those that are not told apart, none where it is not said.
std::string_view name_of(Closure closure);

/// The closure of that word.
Closure closure_of(std::string_view name);

}  // namespace samara
