#include "samara/commands/shared/scene_bodies.hpp"

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "samara/commands/shared/body_cache.hpp"
#include "samara/commands/shared/load_body.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/input_file.hpp"
#include "samara/kirchhoff/kirchhoff_solver.hpp"
#include "samara/kirchhoff/surface_flow.hpp"

namespace samara {
namespace {

/// The file a body of the scene flies with: the baked one where a folder of them is given.
std::filesystem::path file_of(const SceneBody& scene_body, const std::string& bodies) {
    if (bodies.empty()) return scene_body.shape;
    const auto baked = std::filesystem::path(bodies) / (scene_body.name + ".body.h5");
    if (const std::string error = reading_error(baked); !error.empty()) {
        throw Error(
            fmt::format("{}: {}; bake it with 'samara bake SCENE -o {}'", baked.string(), error, bodies));
    }
    return baked;
}

/// Rejects a body that was baked before its shape was changed.
void require_same_shape(const std::filesystem::path& file, const Body& body, const SceneBody& scene_body) {
    if (is_body_file_name(scene_body.shape)) return;
    if (body.source.find(file_content_hash(scene_body.shape)) != std::string::npos) return;
    throw Error(fmt::format("{}: was not made from the current {}; bake the scene again", file.string(),
                            scene_body.shape.string()));
}

/// What a scene asks of the body of a file.
struct Wanted {
    std::filesystem::path file;
    ShapeReading reading;
    bool added_mass = false;
    bool surface_loads = false;

    bool operator==(const Wanted&) const = default;
};

/// Solves what lacks of the body.
void complete(Body& body, const Wanted& wanted) {
    const std::string label = wanted.file.string();
    if (wanted.added_mass && !body.kirchhoff) {
        body.kirchhoff = labelled(label, [&] { return kirchhoff_tensor(body); });
    }
    if (wanted.surface_loads && !body.surface_loads) {
        body.surface_loads =
            labelled(label, [&] { return samara::surface_loads(body.surface, body.moments); });
    }
}

/// What is not in the file itself is made once for good, where the file tells all that it depends on.
Body loaded_body(const Wanted& wanted, const std::optional<std::string>& key) {
    std::optional<Body> body;
    if (is_body_file_name(wanted.file) || is_hdf5(wanted.file)) {
        body = load_body(wanted.file, wanted.reading);
        const bool is_complete =
            (body->kirchhoff || !wanted.added_mass) && (body->surface_loads || !wanted.surface_loads);
        if (is_complete) return *std::move(body);
    }
    const BodyCache cache;
    const std::string entry = fmt::format("{}\n{} {} {} {}", key.value_or(""), wanted.reading.scale,
                                          wanted.reading.thickness, wanted.added_mass, wanted.surface_loads);
    if (key) {
        if (auto kept = cache.find(entry)) return *std::move(kept);
    }
    if (!body) body = load_body(wanted.file, wanted.reading);
    complete(*body, wanted);
    // A file that was written meanwhile may be another than the key's.
    if (key && body_key(wanted.file) == key) cache.keep(entry, *body);
    return *std::move(body);
}

/// The bodies that scenes of this process asked for last, with what was made of them for the steps: a program
/// that flies one scene after the other reads and prepares each body once. Safe to call from several threads.
class LoadedBodies {
  public:
    LoadedBody operator()(const Wanted& wanted) {
        static_cast<void>(InputFile(wanted.file));  // which says what is wrong with it
        const std::optional<std::string> key = body_key(wanted.file);
        const std::lock_guard lock(mutex_);
        const auto known = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
            return entry.key == key && entry.wanted == wanted;
        });
        if (key && known != entries_.end()) {
            std::rotate(known, known + 1, entries_.end());
            return entries_.back().body;
        }
        LoadedBody body(loaded_body(wanted, key), file_content_hash(wanted.file));
        if (!key) return body;
        if (entries_.size() == most) entries_.erase(entries_.begin());
        entries_.push_back({*key, wanted, body});
        return body;
    }

  private:
    static constexpr std::size_t most = 8;
    struct Entry {
        std::string key;
        Wanted wanted;
        LoadedBody body;
    };

    std::mutex mutex_;
    std::vector<Entry> entries_;  ///< the one that was asked for last at the end
};

/// `folder`: of baked bodies, or empty.
Wanted wanted_of(const SceneBody& scene_body, const std::string& folder) {
    const bool asked = scene_body.loads == Loads::surface;
    return {.file = file_of(scene_body, folder),
            // A baked body is in metres already: the scene's scale went into it.
            .reading = folder.empty() ? reading_of(scene_body) : ShapeReading{},
            .added_mass = scene_body.added_mass,
            .surface_loads = asked || scene_body.open.loads};
}

}  // namespace

std::vector<LoadedBody> load_scene_bodies(Scene& scene, const std::string& folder) {
    static LoadedBodies kept;
    std::vector<LoadedBody> bodies;
    std::vector<Wanted> all_wanted;
    for (SceneBody& body : scene.bodies) {
        const Wanted wanted = wanted_of(body, folder);
        const auto same = std::find(all_wanted.begin(), all_wanted.end(), wanted);
        bodies.push_back(same == all_wanted.end()
                             ? kept(wanted)
                             : bodies[static_cast<std::size_t>(same - all_wanted.begin())]);
        all_wanted.push_back(wanted);
        if (!folder.empty()) require_same_shape(wanted.file, *bodies.back().body, body);
        if (!body.models_auto) choose_open_models(*bodies.back().body, body.open, body);
    }
    return bodies;
}

}  // namespace samara
