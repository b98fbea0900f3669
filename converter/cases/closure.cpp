#include "converter/cases/closure.hpp"

#include <algorithm>
#include <utility>

namespace samara {
namespace {

constexpr std::pair<Closure, std::string_view> closures[] = {
    {Closure::unsaid, ""},
    {Closure::laminar, "laminar"},
    {Closure::k_epsilon, "kEpsilon"},
    {Closure::realizable_k_epsilon, "realizableKE"},
    {Closure::rng_k_epsilon, "RNGkEpsilon"},
    {Closure::launder_sharma_k_epsilon, "LaunderSharmaKE"},
    {Closure::k_omega, "kOmega"},
    {Closure::k_omega_sst, "kOmegaSST"},
    {Closure::k_omega_sst_lm, "kOmegaSSTLM"},
    {Closure::k_omega_sst_ddes, "kOmegaSSTDDES"},
    {Closure::spalart_allmaras, "SpalartAllmaras"},
    {Closure::other, "other"}};

}  // namespace

std::string_view name_of(Closure closure) {
    return std::ranges::find(closures, closure, &std::pair<Closure, std::string_view>::first)->second;
}

Closure closure_of(std::string_view name) {
    const auto* const found =
        std::ranges::find(closures, name, &std::pair<Closure, std::string_view>::second);
    return found == std::end(closures) ? Closure::other : found->first;
}

}  // namespace samara
