#include "samara/internal/plot/strip_panel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "samara/internal/plot/axis_scale.hpp"
#include "samara/internal/plot/silhouette.hpp"

namespace samara {
namespace {

constexpr double left_edge = 125.0;
constexpr double widest = 900.0;  // both views and their gap
constexpr double narrowest_view = 250.0;
constexpr double gap = 60.0;
constexpr double time_labels = 115.0;
// Pixels between tics, and of their numbers.
constexpr double x_least = 85.0;
constexpr double x_widest = 77.0;
constexpr double z_least = 70.0;
constexpr double z_widest = 95.0;
constexpr double margin_share = 0.035;       // of the path's height or width, left free around it
constexpr std::size_t most_painted = 30000;  // triangles in all silhouettes of a view, with their far sides
constexpr std::size_t most_triangles = 4000;
constexpr double rim_width = 1.4;
constexpr double overlap = 0.7;

struct ViewFrame {
    View view;
    const char* horizontal;
    Range range;  ///< m
    Box box;
    AxisScale scale = {};
};

struct Scene {
    ShadedMesh mesh;
    std::vector<ShapePose> poses;
    std::array<ViewFrame, 2> views;
    Range height;  ///< m
    AxisScale height_scale;
    double pixel = 1.0;  ///< m
};

void widen(Range& range, double value) {
    range.low = std::min(range.low, value);
    range.high = std::max(range.high, value);
}

void grow(Range& range, double size) {
    const double middle = 0.5 * (range.low + range.high);
    range = {middle - 0.5 * size, middle + 0.5 * size};
}

/// All that is to be seen: the silhouettes' vertices and the path.
void find_ranges(Scene& scene, const Motion& motion, const BodyMotion& body, int run, int copy,
                 const Strip& strip) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    scene.height = {infinity, -infinity};
    for (ViewFrame& frame : scene.views) frame.range = {infinity, -infinity};
    const auto see = [&](const Vector3d& place) {
        widen(scene.height, place.z());
        for (ViewFrame& frame : scene.views) widen(frame.range, frame.view.project(place).x());
    };
    for (int i = strip.first; i <= strip.last; ++i) see(motion.pose(body, run, i, copy).position);
    for (const int i : strip.frames) {
        const ShapePose& pose = scene.poses[static_cast<std::size_t>(i)];
        for (const Vector3d& vertex : scene.mesh.positions) see(pose.position + pose.orientation * vertex);
    }
}

/// The largest scale at which both views fit, then frames around them.
void lay_out(Scene& scene) {
    auto& [front, side] = scene.views;
    const double tall = canvas::top - canvas::bottom;
    double wide_range = front.range.size() + side.range.size();
    const double margin = margin_share * std::max(scene.height.size(), 0.5 * wide_range);
    grow(scene.height, scene.height.size() + 2.0 * margin);
    for (ViewFrame& frame : scene.views) grow(frame.range, frame.range.size() + 2.0 * margin);
    wide_range += 4.0 * margin;
    scene.pixel = std::max(scene.height.size() / tall, wide_range / (widest - gap));
    const double narrower = std::min(front.range.size(), side.range.size());
    const double wider = std::max(front.range.size(), side.range.size());
    if (narrower < narrowest_view * scene.pixel) {
        scene.pixel = std::max(scene.height.size() / tall, wider / (widest - gap - narrowest_view));
    }
    grow(scene.height, tall * scene.pixel);
    scene.height_scale = axis_scale(scene.height, tall, z_least, z_widest);
    double left = left_edge;
    for (ViewFrame& frame : scene.views) {
        const double wide = std::max(frame.range.size() / scene.pixel, narrowest_view);
        grow(frame.range, wide * scene.pixel);
        frame.box = {left, left + wide, canvas::bottom, canvas::top};
        frame.scale = axis_scale(frame.range, wide, x_least, x_widest);
        left += wide + gap;
    }
}

/// As fine a mesh as the number of silhouettes allows.
ShadedMesh mesh_for(const Surface& surface, std::size_t silhouettes) {
    const std::size_t most = most_painted / silhouettes;
    ShadedMesh mesh = shaded_mesh(simplified_surface(surface, std::min(most, most_triangles)));
    while (!mesh.triangles.empty() && 4 * mesh.triangles.size() <= most) mesh = subdivided(mesh);
    return mesh;
}

std::string path_data(const Scene& scene, const Motion& motion, const BodyMotion& body, int run, int copy,
                      const Strip& strip) {
    std::string data = "$path << EOD\n";
    for (int i = strip.first; i <= strip.last; ++i) {
        const Vector3d& place = motion.pose(body, run, i, copy).position;
        data += fmt::format("{:.7g} {:.7g} {:.7g}\n", scene.views[0].scale.number(place.x()),
                            scene.views[1].scale.number(place.y()), scene.height_scale.number(place.z()));
    }
    return data + "EOD\n";
}

std::string silhouette_data(const Scene& scene, const ViewFrame& frame, const Motion& motion,
                            const Strip& strip) {
    fmt::memory_buffer data;
    auto out = std::back_inserter(data);
    fmt::format_to(out, "${}_silhouettes << EOD\n", frame.horizontal);
    for (const int i : strip.frames) {
        for (const PaintedTriangle& triangle : painted_silhouette(
                 scene.mesh, scene.poses[static_cast<std::size_t>(i)], frame.view,
                 time_color(share_of(motion, strip, i)), rim_width * scene.pixel, overlap * scene.pixel)) {
            for (const std::size_t corner : {0U, 1U, 2U, 0U}) {
                const Vector2d& place = triangle.corners[corner];
                fmt::format_to(out, "{:.7g} {:.7g} {}\n", frame.scale.number(place.x()),
                               scene.height_scale.number(place.y()), triangle.color);
            }
            fmt::format_to(out, "\n");
        }
    }
    fmt::format_to(out, "EOD\n");
    return fmt::to_string(data);
}

/// The times of silhouettes beside the side view, where there is room for them.
std::string time_texts(const Scene& scene, const Motion& motion, const BodyMotion& body, int run, int copy,
                       const Strip& strip) {
    std::string texts;
    std::vector<double> taken;
    for (const int i : strip.frames) {
        const double z = motion.pose(body, run, i, copy).position.z();
        const double y = canvas::bottom + (z - scene.height.low) / scene.pixel;
        const bool free = std::all_of(taken.begin(), taken.end(), [&](double other) {
            return std::abs(y - other) > 1.3 * canvas::text_size;
        });
        if (!free) continue;
        taken.push_back(y);
        texts += label(fmt::format("{:.2f} s", motion.times[static_cast<std::size_t>(i)]),
                       scene.views[1].box.right + 14.0, y, "left",
                       packed(0.8 * time_color(share_of(motion, strip, i))));
    }
    return texts;
}

std::string view_plot(const Scene& scene, const ViewFrame& frame, bool first) {
    std::string plot = place_frame(frame.box);
    const Range numbers = frame.scale.numbers(frame.range);
    const Range heights = scene.height_scale.numbers(scene.height);
    plot += axis("x", numbers, tic_step(numbers, frame.box.right - frame.box.left, x_least));
    plot += axis("y", heights, tic_step(heights, frame.box.top - frame.box.bottom, z_least));
    plot += first ? "set format y '%g'\n" : "set format y ''\n";
    plot += x_title(frame.scale.title(frame.horizontal), frame.box);
    if (first) plot += height_title(scene.height_scale, frame.box);
    plot += bold_label(first ? "From the front" : "From the side", frame.box.left,
                       frame.box.top + canvas::header_lift, "left", black);
    plot += fmt::format(
        "plot $path using {}:3 with lines lc rgb '#9a9a9a' lw 2 notitle, ${}_silhouettes using 1:2:3 with "
        "filledcurves closed fs solid 1 noborder fc rgb variable notitle\n",
        first ? 1 : 2, frame.horizontal);
    return plot + "unset label\n";
}

}  // namespace

double share_of(const Motion& motion, const Strip& strip, int frame) {
    const auto time = [&](int i) { return motion.times[static_cast<std::size_t>(i)]; };
    const double length = time(strip.last) - time(strip.first);
    return length > 0.0 ? (time(frame) - time(strip.first)) / length : 0.0;
}

StripPanel strip_panel(const Motion& motion, const BodyMotion& body, int run, int copy, const Strip& strip) {
    Scene scene;
    scene.mesh = mesh_for(body.surface, strip.frames.size());
    for (Vector3d& position : scene.mesh.positions) position *= body.size(run, copy);
    scene.poses = shape_poses(motion, body, run, copy);
    scene.views[0] = {front_view(), "x", {}, {}};
    scene.views[1] = {side_view(), "y", {}, {}};
    find_ranges(scene, motion, body, run, copy, strip);
    lay_out(scene);
    StripPanel panel;
    panel.data = path_data(scene, motion, body, run, copy, strip);
    for (const ViewFrame& frame : scene.views) panel.data += silhouette_data(scene, frame, motion, strip);
    panel.plots = view_plot(scene, scene.views[0], true);
    panel.plots += time_texts(scene, motion, body, run, copy, strip);
    panel.plots += view_plot(scene, scene.views[1], false);
    panel.right = scene.views[1].box.right + time_labels;
    return panel;
}

}  // namespace samara
