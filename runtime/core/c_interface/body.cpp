#include <algorithm>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "samara.h"
#include "samara/core/base/version.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/c_interface/guard.hpp"
#include "samara/core/c_interface/objects.hpp"
#include "samara/core/files/confined_process.hpp"
#include "samara/core/surface/curved_surface.hpp"

namespace {

using samara::guarded;
using samara::hdf5_mutex;
using samara::require;

void require_capacity(std::size_t capacity, std::size_t needed, const char* what) {
    if (capacity >= needed) return;
    throw samara::StatusError(
        SAMARA_INVALID_ARGUMENT,
        fmt::format("capacity is {}, but the {} need {}; give a larger array", capacity, what, needed));
}

/// `untrusted`: whether a process of its own reads the file first.
samara_status load(const char* file, bool untrusted, samara_body** body, char* error, size_t error_size) {
    return guarded(
        error, error_size,
        [&] {
            require(body, "body");
            *body = nullptr;
            require(file, "file");
            const std::lock_guard lock(hdf5_mutex());
            if (untrusted) {
                samara::check_confined(samara::InputFile(file), [&] {
                    (void)samara::read_body_file(file);
                    return std::string("body");
                });
            }
            samara::LoadedBody loaded = samara::load_body_file(file);
            samara::Surface flat = samara::flattened_surface(loaded.body->surface);
            *body = new samara_body{std::move(loaded), std::move(flat)};
        },
        SAMARA_UNREADABLE_FILE);
}

}  // namespace

int samara_api_version(void) {
    return SAMARA_API_VERSION;
}

const char* samara_version(void) {
    return samara::version;
}

samara_status samara_body_load(const char* file, samara_body** body, char* error, size_t error_size) {
    return load(file, false, body, error, error_size);
}

samara_status samara_body_load_untrusted(const char* file, samara_body** body, char* error,
                                         size_t error_size) {
    return load(file, true, body, error, error_size);
}

void samara_body_free(samara_body* body) {
    delete body;
}

const char* samara_body_name(const samara_body* body) {
    return body == nullptr ? "" : body->loaded.body->name.c_str();
}

const char* samara_body_source(const samara_body* body) {
    return body == nullptr ? "" : body->loaded.body->source.c_str();
}

double samara_body_volume(const samara_body* body) {
    return body == nullptr ? 0.0 : body->loaded.body->moments.volume;
}

double samara_body_mass(const samara_body* body) {
    if (body == nullptr || !body->loaded.body->mass) return 0.0;
    return samara::mass_properties(*body->loaded.body, *body->loaded.body->mass).mass;
}

int samara_body_has_added_mass(const samara_body* body) {
    return body != nullptr && body->loaded.body->kirchhoff.has_value() ? 1 : 0;
}

int samara_body_has_tables(const samara_body* body) {
    return body != nullptr && body->loaded.body->tables.has_value() ? 1 : 0;
}

int samara_body_has_surface_loads(const samara_body* body) {
    return body != nullptr && body->loaded.body->surface_loads.has_value() ? 1 : 0;
}

int samara_body_recommended_loads(const samara_body* body) {
    if (body == nullptr) return SAMARA_LOADS_NONE;
    const samara::Body& content = *body->loaded.body;
    if (!content.tables && !content.surface_loads) return SAMARA_LOADS_NONE;
    samara::BodyPhysics physics;
    samara::choose_open_models(content, {.loads = true, .patches = true, .turbulence = true}, physics);
    return static_cast<int>(physics.loads);
}

size_t samara_body_vertex_count(const samara_body* body) {
    return body == nullptr ? 0 : body->flat.vertices.size();
}

size_t samara_body_triangle_count(const samara_body* body) {
    return body == nullptr ? 0 : body->flat.corners.size();
}

samara_status samara_body_get_vertices(const samara_body* body, double* coordinates, size_t capacity,
                                       char* error, size_t error_size) {
    return guarded(error, error_size, [&] {
        require(body, "body");
        require(coordinates, "coordinates");
        require_capacity(capacity, 3 * body->flat.vertices.size(), "coordinates");
        for (const samara::Vector3d& vertex : body->flat.vertices) {
            coordinates = std::copy_n(vertex.data(), 3, coordinates);
        }
    });
}

samara_status samara_body_get_triangles(const samara_body* body, int32_t* corners, size_t capacity,
                                        char* error, size_t error_size) {
    return guarded(error, error_size, [&] {
        require(body, "body");
        require(corners, "corners");
        require_capacity(capacity, 3 * body->flat.corners.size(), "corners");
        for (const auto& triangle : body->flat.corners) {
            corners = std::copy(triangle.begin(), triangle.end(), corners);
        }
    });
}
