#include "foam-cases/scene/scene_plan_picture.hpp"

#include <cmath>

#include <fmt/format.h>

#include "converter/tables/direction_sampling.hpp"
#include "samara/internal/plot/canvas.hpp"
#include "samara/internal/plot/gnuplot.hpp"
#include "samara/internal/plot/heading.hpp"

namespace samara {
namespace {

constexpr std::size_t most_dots = 4000;
constexpr double most_name = 1000.0;  // pixels

/// A direction in the half of the sphere that it is on: Lambert's azimuthal projection, equal in area, so
/// that as many dots are as much time.
std::string point_on(const Vector3d& direction, bool upper) {
    const double height = upper ? direction.z() : -direction.z();
    const double scale = std::sqrt(1.0 / (1.0 + height));
    return fmt::format("{:.4f} {:.4f}\n", scale * direction.x(), scale * direction.y());
}

std::string block(const std::string& name, const std::vector<Vector3d>& directions, bool upper) {
    std::string text = fmt::format("${} << EOD\n", name);
    for (const Vector3d& direction : directions) {
        const bool here = upper ? direction.z() >= -1e-9 : direction.z() <= 1e-9;
        if (here) text += point_on(direction, upper);
    }
    // A block without a point is none to gnuplot.
    return text + "NaN NaN\nEOD\n";
}

std::vector<Vector3d> images_of_cases(const Symmetry& symmetry, const ScenePlan& plan) {
    std::vector<Vector3d> images;
    for (const std::size_t index : plan.chosen) {
        for (const Matrix3d& element : elements_in_map_axes(symmetry)) {
            images.push_back(element * plan.candidates.directions[index]);
        }
    }
    return images;
}

}  // namespace

void draw_plan(const std::filesystem::path& file, const std::string& name,
               const std::vector<FlowVisit>& visits, const Symmetry& symmetry, const ScenePlan& plan) {
    std::vector<Vector3d> visited;
    const std::size_t stride = 1 + visits.size() / most_dots;
    for (std::size_t i = 0; i < visits.size(); i += stride) {
        visited.push_back(symmetry.axes.transpose() * visits[i].direction);
    }
    const std::vector<Vector3d> cases = images_of_cases(symmetry, plan);
    std::string commands =
        fmt::format("set multiplot layout 1,2 title {} noenhanced font ',22'\n",
                    quoted(shortened(name, 22.0, most_name) + ": directions of motion in the body's axes"));
    commands += "set size ratio -1\nunset xtics\nunset ytics\nunset border\nunset grid\n";
    commands += "set xrange [-1.15:1.15]\nset yrange [-1.15:1.15]\nset parametric\nset trange [0:2*pi]\n";
    commands += "set key at screen 0.5,0.05 center horizontal Left reverse samplen 1 font ',18'\n";
    for (const bool upper : {true, false}) {
        if (!upper) commands += "unset key\n";  // one serves both
        commands += block("visited", visited, upper) + block("cases", cases, upper);
        commands += fmt::format(
            "set title 'along {}z' font ',18'\nset label 1 'x' at 1.06,0 center\nset label 2 'y' at 0,1.06 "
            "center\n"
            "plot cos(t),sin(t) with lines lc rgb '#999999' lw 2 notitle, "
            "$visited with points pt 7 ps 0.5 lc rgb '#3070b0' title 'visited', "
            "$cases with points pt 6 ps 2.6 lw 3 lc rgb '#d06010' title 'case or its image'\n",
            upper ? "+" : "-");
    }
    commands += "unset multiplot\n";
    draw_picture(file, commands);
}

}  // namespace samara
