#ifdef SAMARA_PAGE_FILE
// The page is some 700 kB: the assembler copies the file, where a compiler would parse every byte.
asm(".pushsection .rodata\n"
    ".balign 16\n"
    ".hidden samara_page_begin\n"
    ".global samara_page_begin\n"
    "samara_page_begin:\n"
    ".incbin \"" SAMARA_PAGE_FILE
    "\"\n"
    ".hidden samara_page_end\n"
    ".global samara_page_end\n"
    "samara_page_end:\n"
    ".byte 0\n"
    ".popsection\n");
extern "C" {
extern const char samara_page_begin[];
extern const char samara_page_end[];
}
#endif
#include "samara/export/page_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <ostream>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "samara/core/base/error.hpp"
#include "samara/core/base/text.hpp"
#include "samara/core/files/replace_file.hpp"
#include "samara/core/surface/display_image.hpp"
#include "samara/export/float_range.hpp"
#include "samara/export/shaded_mesh.hpp"
#include "samara/motion/inclination.hpp"

namespace samara {
namespace {

/// Returns the player's page with the mark <!--MOTION--> in it; empty where it was not built in.
std::string_view page_bytes() {
#ifdef SAMARA_PAGE_FILE
    return {samara_page_begin, static_cast<std::string_view::size_type>(samara_page_end - samara_page_begin)};
#else
    return {};
#endif
}

constexpr std::string_view mark = "<!--MOTION-->";
constexpr std::size_t floats_of_pose = 10;  // as runtime/page/motion.js reads them
constexpr std::size_t floats_of_forces = 12;
constexpr double most_bytes = 384e6;

/// Writes an array, which motion.js finds by its name.
template <typename Number>
void write_array(std::ostream& stream, const std::string& name, const std::vector<Number>& numbers) {
    stream << "<script type=\"text/plain\" id=\"motion-" << name << "\">"
           << base64({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)})
           << "</script>\n";
}

void append_floats(std::vector<float>& floats, const auto& values) {
    for (const double value : values) floats.push_back(static_cast<float>(value));
}

/// Returns the distance (m) from the centre of mass to the body's farthest point.
double radius_of(const BodyMotion& body) {
    double radius = 0.0;
    for (const Vector3d& vertex : body.surface.vertices) {
        radius = std::max(radius, (vertex - body.center_of_mass).norm());
    }
    return radius;
}

std::vector<float> poses_of(const Motion& motion, const BodyMotion& body, int run) {
    const Vector3d down = down_direction(motion.gravity);
    std::vector<float> floats;
    floats.reserve(floats_of_pose * motion.times.size() * static_cast<std::size_t>(body.copies));
    for (int frame = 0; frame < motion.frames(); ++frame) {
        for (int copy = 0; copy < body.copies; ++copy) {
            const Pose& pose = motion.pose(body, run, frame, copy);
            append_floats(floats, pose.position);
            append_floats(floats, pose.orientation.normalized().coeffs());  // x, y, z, w
            append_floats(floats,
                          std::array<double, 3>{pose.velocity.dot(down), inclination(motion, body, pose),
                                                pose.angular_velocity.norm()});
        }
    }
    return floats;
}

/// Returns the forces (N) as runtime/page/forces.js reads them.
std::vector<float> forces_of(const Motion& motion, const BodyMotion& body, int run) {
    std::vector<float> floats;
    for (int frame = 0; frame < motion.frames(); ++frame) {
        for (int copy = 0; copy < body.copies; ++copy) {
            const FluidForces& forces = body.forces[motion.index(body, run, frame, copy)];
            for (const Wrench* wrench : {&forces.drag, &forces.lift, &forces.inertia, &forces.noise}) {
                append_floats(floats, wrench->force);
            }
        }
    }
    return floats;
}

/// Writes the arrays NAME-points, NAME-normals and NAME-triangles, about `origin` (m, shape axes).
void write_mesh(std::ostream& stream, const std::string& name, const Surface& surface,
                const Vector3d& origin) {
    const ShadedMesh mesh = shaded_mesh(surface);
    std::vector<float> points;
    std::vector<float> normals;
    std::vector<std::uint32_t> triangles;
    for (const Vector3d& position : mesh.positions) append_floats(points, Vector3d(position - origin));
    for (const Vector3d& normal : mesh.normals) append_floats(normals, normal);
    for (const auto& triangle : mesh.triangles)
        triangles.insert(triangles.end(), triangle.begin(), triangle.end());
    write_array(stream, name + "-points", points);
    write_array(stream, name + "-normals", normals);
    write_array(stream, name + "-triangles", triangles);
}

/// Writes what write_mesh() writes, of a display mesh with its triangles in the order of their materials, and
/// its texture coordinates and images.
void write_display(std::ostream& stream, const std::string& name, const DisplayMesh& display,
                   const Vector3d& origin) {
    std::vector<float> points;
    std::vector<float> normals;
    std::vector<float> texture;
    std::vector<std::int32_t> triangles;
    for (const Vector3d& position : display.positions) append_floats(points, Vector3d(position - origin));
    for (const Vector3d& normal : display.normals) append_floats(normals, normal);
    for (const Eigen::Vector2d& place : display.texture) append_floats(texture, place);
    for (std::size_t slot = 0; slot < display.materials.size(); ++slot) {
        for (std::size_t i = 0; i < display.corners.size(); ++i) {
            if (display.slots[i] != static_cast<std::int32_t>(slot)) continue;
            triangles.insert(triangles.end(), display.corners[i].begin(), display.corners[i].end());
        }
    }
    write_array(stream, name + "-points", points);
    write_array(stream, name + "-normals", normals);
    write_array(stream, name + "-texture", texture);
    write_array(stream, name + "-triangles", triangles);
    for (std::size_t i = 0; i < display.images.size(); ++i) {
        const std::string& bytes = display.images[i].bytes;
        write_array(stream, fmt::format("{}-image-{}", name, i),
                    std::vector<char>(bytes.begin(), bytes.end()));
    }
}

/// Returns the materials of a display mesh, each with the number of its triangles, and the types of its
/// images.
nlohmann::json look_of(const DisplayMesh& display) {
    nlohmann::json look = {{"materials", nlohmann::json::array()}, {"images", nlohmann::json::array()}};
    for (std::size_t slot = 0; slot < display.materials.size(); ++slot) {
        const DisplayMaterial& material = display.materials[slot];
        look["materials"].push_back(
            {{"color", material.color},
             {"image", material.image},
             {"cut_out", material.transparency == DisplayTransparency::cut_out},
             {"blended", material.transparency == DisplayTransparency::blended || material.color[3] < 1.0},
             {"triangles", std::count(display.slots.begin(), display.slots.end(), slot)}});
    }
    for (const DisplayImage& image : display.images) {
        look["images"].push_back(image_type(image.bytes) == std::string_view("png") ? "image/png"
                                                                                    : "image/jpeg");
    }
    return look;
}

/// Returns position and quaternion (x, y, z, w) of an obstacle at each frame; for one at rest once.
std::vector<float> places_of(const Motion& motion, const Obstacle& obstacle) {
    std::vector<float> floats;
    for (const double time : motion.times) {
        const ObstaclePlace place = samara::place_of(obstacle, time);
        append_floats(floats, place.position);
        append_floats(floats, place.orientation.coeffs());
        if (!obstacle.moves()) break;
    }
    return floats;
}

/// Returns the page's description of the motion, JSON in ASCII and without "<": nothing in it ends or opens
/// an element of the page.
std::string header_of(const Motion& motion, int run, const std::string& title, const std::string& detail,
                      const CopyStyle& style) {
    nlohmann::json header = {{"title", title},
                             {"detail", detail},
                             {"frame_rate", motion.frame_rate},
                             {"first_copy", style.first},
                             {"has_forces", motion.has_forces},
                             {"colors", nlohmann::json::array()}};
    for (const Vector3d& color : style.colors) header["colors"].push_back({color.x(), color.y(), color.z()});
    header["ground"] = motion.ground ? nlohmann::json(*motion.ground) : nlohmann::json(nullptr);
    for (const BodyMotion& body : motion.bodies) {
        header["bodies"].push_back(
            {{"name", body.name}, {"copies", body.copies}, {"radius", radius_of(body)}});
        if (body.display != nullptr) header["bodies"].back()["look"] = look_of(*body.display);
        for (int copy = 0; !body.sizes.empty() && copy < body.copies; ++copy) {
            header["bodies"].back()["sizes"].push_back(body.size(run, copy));
        }
    }
    header["obstacles"] = nlohmann::json::array();
    for (const Obstacle& obstacle : motion.obstacles)
        header["obstacles"].push_back({{"name", obstacle.name}});
    std::string text = header.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
        text.replace(at, 1, "\\u003c");
    }
    return text;
}

void require_size(const std::filesystem::path& file, const Motion& motion) {
    double poses = 0.0;
    for (const BodyMotion& body : motion.bodies) {
        poses = std::max(poses, static_cast<double>(motion.times.size()) * body.copies);
    }
    const std::size_t floats = floats_of_pose + (motion.has_forces ? floats_of_forces : 0);
    const double bytes = poses * static_cast<double>(floats * sizeof(float)) * 4.0 / 3.0;
    if (bytes > most_bytes) {
        throw Error(
            fmt::format("{}: the poses need {:.0f} MB, but the limit of browsers is {:.0f}; give a lower "
                        "--frame-rate, or simulate fewer copies",
                        file.string(), 1e-6 * bytes, 1e-6 * most_bytes));
    }
}

}  // namespace

bool has_page() {
    return !page_bytes().empty();
}

void write_page(const std::filesystem::path& file, const Motion& motion, int run, const std::string& title,
                const std::string& detail, const CopyStyle& style) {
    const std::string_view page = page_bytes();
    const std::size_t place = page.find(mark);
    if (place == std::string_view::npos) {
        throw Error(
            fmt::format("{}: this samara was built without the page; configure it with -DSAMARA_PAGE=ON and "
                        "npm, or write .glb",
                        file.string()));
    }
    require_size(file, motion);
    require_float_range(file, motion, run);
    replace_file_by_stream(file, [&](std::ostream& stream) {
        stream << page.substr(0, place) << "<script type=\"application/json\" id=\"motion-header\">"
               << header_of(motion, run, title, detail, style) << "</script>\n";
        write_array(stream, "times", motion.times);
        for (std::size_t b = 0; b < motion.bodies.size(); ++b) {
            const BodyMotion& body = motion.bodies[b];
            if (body.display != nullptr) {
                write_display(stream, std::to_string(b), *body.display, body.center_of_mass);
            } else {
                write_mesh(stream, std::to_string(b), body.surface, body.center_of_mass);
            }
            write_array(stream, fmt::format("{}-poses", b), poses_of(motion, body, run));
            if (motion.has_forces) {
                write_array(stream, fmt::format("{}-forces", b), forces_of(motion, body, run));
            }
        }
        for (std::size_t i = 0; i < motion.obstacles.size(); ++i) {
            const std::string name = fmt::format("obstacle-{}", i);
            write_mesh(stream, name, motion.obstacles[i].surface, Vector3d::Zero());
            write_array(stream, name + "-places", places_of(motion, motion.obstacles[i]));
        }
        stream << page.substr(place + mark.size());
    });
}

}  // namespace samara
