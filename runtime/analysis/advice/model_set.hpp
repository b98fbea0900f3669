#pragma once

#include <compare>
#include <optional>
#include <string>

#include "samara/core/body/body.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// The models that a body is simulated with: the part of a SceneBody that the model advice may change.
struct ModelSet {
    Loads loads = Loads::table;
    double drag_coefficient = 1.0;  ///< where loads are coefficients
    std::optional<double> table_reynolds_number = {};
    bool added_mass = true;
    Dynamic dynamic = Dynamic::of_body;
    Turbulence turbulence = Turbulence::table;
    double turbulent_kinetic_energy = 0.0;  ///< m^2/s^2, where turbulence is constant
    double dissipation_rate = 0.0;          ///< m^2/s^3, where turbulence is constant

    bool operator==(const ModelSet&) const = default;
};

/// Returns the models of a scene's body.
ModelSet model_set_of(const SceneBody& body);

/// Gives the scene's body these models.
void set_models(const ModelSet& models, SceneBody& body);

/// Parts that a set of models may leave out, the dearest to make first.
enum class ModelPart {
    identified_coefficients,  ///< free falls in full CFD
    table_loads,              ///< OpenFOAM cases in many directions
    turbulence,               ///< k and epsilon of those cases
    reynolds_dependence,      ///< the cases at further Reynolds numbers
    added_mass,               ///< the Kirchhoff tensor: a second of boundary elements
    dynamic_coefficients,     ///< nothing: work in the step alone
};

/// The cost of a set: the data that must be made before a body can be simulated with it, dearest first, and
/// then the work of a step. Sets are compared in this order, member by member.
struct ModelCost {
    bool falls = false;             ///< free falls in full CFD, for identified coefficients
    bool tables = false;            ///< OpenFOAM cases
    bool reynolds_numbers = false;  ///< cases at further Reynolds numbers
    bool kirchhoff = false;         ///< the added mass
    int step = 0;  ///< work of a step: 5 for turbulence from tables and 4 for constant, 2 for table loads, 1
                   ///< for coefficients in motion

    // NOLINTNEXTLINE(modernize-use-nullptr): what the compiler compares the order with
    auto operator<=>(const ModelCost&) const = default;
};

/// Returns the cost of a set that the body can be simulated with.
ModelCost cost_of(const ModelSet& models, const Body& body);

/// Returns whether the set takes loads or turbulence from tables.
bool uses_tables(const ModelSet& models);

/// Returns the set as text, such as "table loads, added mass, default dynamic coefficients, no turbulence".
std::string in_words(const ModelSet& models, const Body& body);

/// Returns the name of a part: "table loads", "added mass", ...
const char* name_of(ModelPart part);

}  // namespace samara
