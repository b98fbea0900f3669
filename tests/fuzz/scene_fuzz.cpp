// Scene files. What is accepted and soon flown is flown.

#include <filesystem>
#include <fstream>
#include <vector>

#include "harness.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/folders.hpp"
#include "samara/scene/scene_file.hpp"
#include "samara/scene/scene_simulation.hpp"
#include "support/known_bodies.hpp"

namespace samara::fuzz {
namespace {

constexpr double most_steps = 500.0;

/// The folder of the scenes, with rubber.body.h5.
class SceneFolder {
  public:
    SceneFolder() {
        body_.name = "rubber";
        body_.source = "invented";
        body_.tables = test::blunt_tables(body_, 2);
        write_body_file(folder_ / "rubber.body.h5", body_);
    }
    [[nodiscard]] std::filesystem::path file() const { return folder_ / "scene.toml"; }

    void fly_if_short(const Scene& scene) const {
        double copies = 0.0;
        for (const SceneBody& body : scene.bodies) {
            if (body.shape.filename() != "rubber.body.h5") return;
            copies += body.count;
        }
        const double steps = scene.duration / scene.step + scene.duration * scene.frame_rate;
        if (!(steps * copies < most_steps)) return;
        const std::vector<LoadedBody> loaded(scene.bodies.size(),
                                             {body_, "0123456789abcdef0123456789abcdef"});
        const auto result = accepted([&] {
            return simulate(
                scene, loaded, 1, [](double, double) { return true; }, 1);
        });
        if (!result) return;
        for (const BodyMotion& body : result->motion.bodies) {
            for (const Pose& pose : body.poses) {
                require(pose.position.allFinite() && pose.orientation.coeffs().allFinite(),
                        "poses are finite");
            }
        }
    }

  private:
    TemporaryFolder folder_;
    Body body_ = test::rubber_ellipsoid();
};

}  // namespace

void feed(std::string_view input) {
    static const SceneFolder folder;
    std::ofstream(folder.file(), std::ios::binary) << input;
    const auto scene = accepted([&] { return read_scene_file(folder.file()); });
    if (scene) folder.fly_if_short(*scene);
}

}  // namespace samara::fuzz
