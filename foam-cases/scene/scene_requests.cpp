#include "foam-cases/scene/scene_requests.hpp"

namespace samara {

std::vector<BakeRequest> requests_for_scene(const Scene& scene, const std::filesystem::path& folder,
                                            const SceneBakeOptions& options) {
    std::vector<BakeRequest> requests;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const SceneBody& body = scene.bodies[i];
        BakeRequest request;
        request.name = body.name;
        request.shape = body.shape;
        request.scale = body.scale;
        request.output = folder / (body.name + ".body.h5");
        request.fluid = scene.fluid;
        request.mass = body.mass;
        request.gravity = scene.gravity.norm();
        request.quality = options.quality;
        request.inflow = options.inflow;
        request.tables = body.loads == Loads::table || body.turbulence == Turbulence::table;
        if (request.tables) {
            request.goal = SceneGoal{.scene = scene,
                                     .body = i,
                                     .tolerance = options.tolerance,
                                     .budget = options.budget,
                                     .most_rounds = options.most_rounds,
                                     .whole_grid = options.whole_grid};
        }
        requests.push_back(std::move(request));
    }
    return requests;
}

}  // namespace samara
