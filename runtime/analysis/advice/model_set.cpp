#include "samara/analysis/advice/model_set.hpp"

#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace samara {
namespace {

bool uses_identified(const ModelSet& models, const Body& body) {
    return models.loads == Loads::table && models.dynamic == Dynamic::of_body && body.dynamic.has_value();
}

std::string loads_in_words(const ModelSet& models) {
    switch (models.loads) {
        case Loads::none:
            return "no loads";
        case Loads::coefficients:
            return fmt::format("drag coefficient {:.3g}", models.drag_coefficient);
        case Loads::surface:
            return "loads of the surface";
        default:
            return "table loads";
    }
}

std::string dynamic_in_words(const ModelSet& models, const Body& body) {
    if (models.dynamic == Dynamic::none) return "no dynamic coefficients";
    if (models.loads == Loads::coefficients) return "rotational drag";
    if (models.loads == Loads::surface) return "dynamic coefficients that all bodies share";
    return uses_identified(models, body) ? "identified dynamic coefficients" : "default dynamic coefficients";
}

std::string turbulence_in_words(const ModelSet& models) {
    switch (models.turbulence) {
        case Turbulence::none:
            return "no turbulence";
        case Turbulence::constant:
            return fmt::format("constant turbulence (k {:.3g} m^2/s^2, epsilon {:.3g} m^2/s^3)",
                               models.turbulent_kinetic_energy, models.dissipation_rate);
        default:
            return models.loads == Loads::surface ? "turbulence that all bodies share"
                                                  : "turbulence from tables";
    }
}

}  // namespace

bool uses_tables(const ModelSet& models) {
    return uses_body_tables(models.loads, models.turbulence);
}

ModelSet model_set_of(const SceneBody& body) {
    return {.loads = body.loads,
            .drag_coefficient = body.coefficients.drag_coefficient,
            .table_reynolds_number = body.table_reynolds_number,
            .added_mass = body.added_mass,
            .dynamic = body.dynamic,
            .turbulence = body.turbulence,
            .turbulent_kinetic_energy = body.turbulent_kinetic_energy,
            .dissipation_rate = body.dissipation_rate};
}

void set_models(const ModelSet& models, SceneBody& body) {
    body.loads = models.loads;
    body.coefficients.drag_coefficient = models.drag_coefficient;
    body.table_reynolds_number = models.table_reynolds_number;
    body.added_mass = models.added_mass;
    body.dynamic = models.dynamic;
    body.turbulence = models.turbulence;
    body.turbulent_kinetic_energy = models.turbulent_kinetic_energy;
    body.dissipation_rate = models.dissipation_rate;
}

ModelCost cost_of(const ModelSet& models, const Body& body) {
    const bool several = body.tables && body.tables->reynolds_numbers.size() > 1;
    ModelCost cost;
    cost.falls = uses_identified(models, body);
    cost.tables = uses_tables(models);
    cost.reynolds_numbers = cost.tables && several && !models.table_reynolds_number;
    cost.kirchhoff = models.added_mass;
    constexpr int turbulence[] = {0, 4, 5};
    cost.step = turbulence[static_cast<int>(models.turbulence)] +
                (models.loads == Loads::table || models.loads == Loads::surface ? 2 : 0) +
                (models.loads != Loads::none && models.dynamic != Dynamic::none ? 1 : 0);
    return cost;
}

std::string in_words(const ModelSet& models, const Body& body) {
    std::vector<std::string> words = {loads_in_words(models)};
    if (uses_tables(models) && models.table_reynolds_number) {
        words.push_back(fmt::format("the Reynolds number {:.4g} alone", *models.table_reynolds_number));
    }
    words.emplace_back(models.added_mass ? "added mass" : "no added mass");
    if (models.loads != Loads::none) words.push_back(dynamic_in_words(models, body));
    words.push_back(turbulence_in_words(models));
    return fmt::format("{}", fmt::join(words, ", "));
}

const char* name_of(ModelPart part) {
    constexpr const char* names[] = {"identified coefficients", "table loads", "turbulence",
                                     "Reynolds dependence",     "added mass",  "dynamic coefficients"};
    return names[static_cast<int>(part)];
}

}  // namespace samara
