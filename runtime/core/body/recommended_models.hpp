#pragma once

#include <string>

#include "samara/core/physics/body_physics.hpp"

namespace samara {

struct Body;

/// The models that a body is best simulated with where a user does not choose them: judged when the body file
/// was made, by the falls that were known of the body.
struct RecommendedModels {
    Loads loads = Loads::table;                 ///< table or surface
    int patches = 1;                            ///< of the surface, 1 to most_surface_patches
    Turbulence turbulence = Turbulence::table;  ///< table or none
    std::string origin = {};                    ///< what they were judged by, in words

    /// Compares member by member.
    bool operator==(const RecommendedModels&) const = default;
};

/// The models that a user leaves to the body file.
struct OpenModels {
    bool loads = false;    ///< whether the file chooses the loads
    bool patches = false;  ///< whether the file chooses the patches, where the loads are those it recommends
    bool turbulence = false;  ///< whether the file chooses the turbulence, or it follows from the loads

    /// Compares member by member.
    bool operator==(const OpenModels&) const = default;
};

/// Returns why a body cannot be simulated with these models, such as "loads are neither 1 nor 2"; empty where
/// it can.
std::string error_of(const RecommendedModels& models);

/// Chooses the models that a user leaves open, where the loads or the patches are among them: as the body
/// file recommends them, or else its tables, or else the loads of its surface. What the user chose stays, and
/// with it all that it needs: turbulence or a Reynolds number of the tables need their loads.
void choose_open_models(const Body& body, const OpenModels& open, BodyPhysics& physics);

}  // namespace samara
