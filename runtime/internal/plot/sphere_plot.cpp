#include "samara/internal/plot/sphere_plot.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "samara/analysis/verdicts/case_records.hpp"
#include "samara/internal/plot/body_picture.hpp"
#include "samara/internal/plot/gnuplot.hpp"
#include "samara/internal/plot/heading.hpp"
#include "samara/internal/plot/silhouette.hpp"

namespace samara {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double half_width = 2.0 * std::numbers::sqrt2;  // of the projected sphere
constexpr double half_height = std::numbers::sqrt2;
constexpr int columns = 240;
constexpr int rows = 120;
constexpr double map_width = 750.0;  // pixels
constexpr double bar_width = 22.0;
constexpr int bar_steps = 64;
constexpr double text_lift = 14.0;

/// The unit vector (right, into the page's middle, up) at a place of the map; none outside of it.
std::optional<Vector3d> direction_at(const Vector2d& place) {
    const double squares =
        (place / half_width).squaredNorm() + 3.0 * place.y() * place.y() / (half_width * half_width);
    if (squares > 1.0) return std::nullopt;
    const double z = std::sqrt(1.0 - place.x() * place.x() / 16.0 - place.y() * place.y() / 4.0);
    const double longitude = 2.0 * std::atan2(z * place.x(), 2.0 * (2.0 * z * z - 1.0));
    const double latitude = std::asin(std::clamp(z * place.y(), -1.0, 1.0));
    return Vector3d(std::cos(latitude) * std::sin(longitude), std::cos(latitude) * std::cos(longitude),
                    std::sin(latitude));
}

Vector2d place_of(const Vector3d& direction) {
    const double longitude = std::atan2(direction.x(), direction.y());
    const double latitude = std::asin(std::clamp(direction.z(), -1.0, 1.0));
    const double root = std::sqrt(1.0 + std::cos(latitude) * std::cos(0.5 * longitude));
    return {half_width * std::cos(latitude) * std::sin(0.5 * longitude) / root,
            half_height * std::sin(latitude) / root};
}

struct Sphere {
    const Body& body;
    double reynolds_number;
    Matrix3d axes;  // columns: right, middle, up of the map in body axes
};

struct Layer {
    const char* title;
    const char* unit;
    double (*value)(const Sphere&, const Vector3d& direction);
};

LoadEntry entry_at(const Sphere& sphere, const Vector3d& direction) {
    return look_up(*sphere.body.tables, direction, sphere.reynolds_number);
}

constexpr Layer layers[] = {
    {"Drag coefficient", "",
     [](const Sphere& sphere, const Vector3d& direction) {
         return -entry_at(sphere, direction).force.dot(direction);
     }},
    {"Moment coefficient, its size", "",
     [](const Sphere& sphere, const Vector3d& direction) {
         return entry_at(sphere, direction).moment.norm();
     }},
    {"Turbulent kinetic energy k/U²", "",
     [](const Sphere& sphere, const Vector3d& direction) {
         return entry_at(sphere, direction).turbulent_kinetic_energy;
     }},
    {"Standard error of the force over the force", " %",
     [](const Sphere& sphere, const Vector3d& direction) {
         const LoadTables& tables = *sphere.body.tables;
         if (tables.errors.size() != tables.entries.size()) return 0.0;
         const double force = entry_at(sphere, direction).force.norm();
         const double error = look_up_error(tables, direction, sphere.reynolds_number).force.norm();
         return force > 0.0 ? 100.0 * error / force : 0.0;
     }},
};

/// The map's raster of one layer, row by row from below, and the values' range.
struct Raster {
    std::vector<std::optional<double>> values;
    std::vector<bool> planned;
    Range range;
};

Raster raster_of(const Sphere& sphere, const Layer& layer) {
    Raster raster{{}, {}, {std::numeric_limits<double>::infinity(), 0.0}};
    const LoadTables& tables = *sphere.body.tables;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const auto on_map = direction_at({half_width * (2.0 * (column + 0.5) / columns - 1.0),
                                              half_height * (2.0 * (row + 0.5) / rows - 1.0)});
            raster.planned.push_back(true);
            if (!on_map) {
                raster.values.emplace_back();
                continue;
            }
            const Vector3d direction = sphere.axes * *on_map;
            raster.planned.back() = tables.plan.holds(tables.axes.transpose() * direction);
            const double value = layer.value(sphere, direction);
            raster.values.emplace_back(value);
            raster.range.low = std::min(raster.range.low, value);
            raster.range.high = std::max(raster.range.high, value);
        }
    }
    return raster;
}

/// Tables of a body that is alike in all directions differ between their nodes, by interpolation, no more.
bool is_flat(const Range& range) {
    return range.size() <= 0.03 * std::max(std::abs(range.high), std::abs(range.low));
}

double share_in(const Range& range, double value) {
    return is_flat(range) ? 0.5 : (value - range.low) / range.size();
}

void append_pixel(fmt::memory_buffer& data, double x, double y, const Color& color, int opacity) {
    const std::uint32_t all = packed(color);
    fmt::format_to(std::back_inserter(data), "{:.5g} {:.5g} {} {} {} {}\n", x, y, all >> 16U,
                   all >> 8U & 255U, all & 255U, opacity);
}

constexpr int faint = 70;  // of 255, where the tables are extrapolated

std::string raster_data(const std::string& block, const Raster& raster) {
    fmt::memory_buffer data;
    fmt::format_to(std::back_inserter(data), "{} << EOD\n", block);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const std::size_t i = static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
            const auto& value = raster.values[i];
            append_pixel(data, half_width * (2.0 * (column + 0.5) / columns - 1.0),
                         half_height * (2.0 * (row + 0.5) / rows - 1.0),
                         time_color(value ? share_in(raster.range, *value) : 0.0),
                         value ? (raster.planned[i] ? 255 : faint) : 0);
        }
    }
    fmt::format_to(std::back_inserter(data), "EOD\n");
    return fmt::to_string(data);
}

std::string bar_data() {
    fmt::memory_buffer data;
    fmt::format_to(std::back_inserter(data), "$bar << EOD\n");
    for (int step = 0; step < bar_steps; ++step) {
        for (const double x : {0.25, 0.75}) {
            append_pixel(data, x, (step + 0.5) / bar_steps, time_color((step + 0.5) / bar_steps), 255);
        }
    }
    fmt::format_to(std::back_inserter(data), "EOD\n");
    return fmt::to_string(data);
}

/// Meridians and circles of latitude every 45 degrees; the map's edge, which smooths the raster's.
std::string grid_data() {
    fmt::memory_buffer data;
    auto out = std::back_inserter(data);
    fmt::format_to(out, "$grid << EOD\n");
    const auto line = [&](const auto& direction) {
        for (int i = 0; i <= 90; ++i) {
            const Vector2d place = place_of(direction(i / 90.0));
            fmt::format_to(out, "{:.5g} {:.5g}\n", place.x(), place.y());
        }
        fmt::format_to(out, "\n");
    };
    const auto at = [](double longitude, double latitude) {
        return Vector3d(std::cos(latitude) * std::sin(longitude), std::cos(latitude) * std::cos(longitude),
                        std::sin(latitude));
    };
    const double edge = pi * (1.0 - 1e-9);
    for (int i = -3; i <= 3; ++i) {
        line([&](double share) { return at(edge * i / 4.0, pi * (share - 0.5)); });
    }
    for (int i = -1; i <= 1; ++i) {
        line([&](double share) { return at(edge * (2.0 * share - 1.0), pi * i / 4.0); });
    }
    fmt::format_to(out, "EOD\n$edge << EOD\n");
    for (const double side : {-edge, edge}) {
        line([&](double share) { return at(side, pi * (share - 0.5)); });
    }
    fmt::format_to(out, "EOD\n");
    return fmt::to_string(data);
}

/// The solved directions at the Reynolds number, on the last mesh or the one before it; returns how many.
int add_cases(const Sphere& sphere, std::string& data) {
    std::vector<Vector3d> directions;
    for (const CaseRecord& record : case_records(*sphere.body.tables)) {
        if (!is_on_last_meshes(record) || record.reynolds_number != sphere.reynolds_number) continue;
        const bool known = std::ranges::any_of(directions, [&](const Vector3d& direction) {
            return (direction - record.direction).norm() < same_direction;
        });
        if (!known) directions.push_back(record.direction);
    }
    data += "$cases << EOD\n";
    for (const Vector3d& direction : directions) {
        const Vector2d place = place_of(sphere.axes.transpose() * direction);
        data += fmt::format("{:.5g} {:.5g}\n", place.x(), place.y());
    }
    data += "EOD\n";
    return static_cast<int>(directions.size());
}

Box map_box(std::size_t layer) {
    Box box = quarter(static_cast<int>(layer % 2), static_cast<int>(layer / 2), false);
    box.left -= 60.0;
    box.right = box.left + map_width;
    box.bottom = box.top - map_width / 2.0;
    return box;
}

std::string number_of(const Layer& layer, double value) {
    return fmt::format("{:.3g}{}", value, layer.unit);
}

std::string layer_plot(std::size_t number, const Raster& raster, bool has_cases) {
    const Layer& layer = layers[number];
    const Box box = map_box(number);
    std::string plot = "unset border; unset tics\n" + place_frame(box);
    plot += fmt::format("set xrange [{0}:{1}]; set yrange [{2}:{3}]\n", -half_width, half_width, -half_height,
                        half_height);
    plot += bold_label(layer.title, box.left, box.top + canvas::header_lift + text_lift, "left", black);
    const double middle = 0.5 * (box.left + box.right);
    plot += label("short axis", middle, box.top + text_lift, "center", gray);
    plot += label("long", middle, 0.5 * (box.top + box.bottom) - 22.0, "center", 0xffffff);
    plot += fmt::format(
        "plot $layer{} using 1:2:3:4:5:6 with rgbalpha notitle, $grid using 1:2 with lines lw 1 lc rgb "
        "'#80ffffff' notitle, $edge using 1:2 with lines lw 6 lc rgb '#ffffff' notitle",
        number);
    if (has_cases) {
        plot +=
            ", $cases using 1:2 with points pt 7 ps 1.1*dot_size lc rgb '#ffffff' notitle, $cases using 1:2 "
            "with points pt 7 ps 0.7*dot_size lc rgb '#d55e00' notitle";
    }
    plot += "\nunset label\n";
    if (is_flat(raster.range)) {
        return plot +
               label(number_of(layer, raster.range.high), box.right + 20.0, 0.5 * (box.top + box.bottom),
                     "left", black) +
               "plot [0:1] [0:1] NaN notitle\nunset label\n";
    }
    const Box bar = {box.right + 25.0, box.right + 25.0 + bar_width, box.bottom + 20.0, box.top - 20.0};
    plot += place_frame(bar) + "set xrange [0:1]; set yrange [0:1]\n";
    for (const double share : {0.0, 0.5, 1.0}) {
        plot += label(number_of(layer, raster.range.low + share * raster.range.size()), bar.right + 10.0,
                      bar.bottom + share * (bar.top - bar.bottom), "left", black);
    }
    return plot + "plot $bar using 1:2:3:4:5:6 with rgbalpha notitle\nunset label\n";
}

double planned_share(const Raster& raster) {
    double all = 0.0;
    double planned = 0.0;
    for (std::size_t i = 0; i < raster.values.size(); ++i) {
        if (!raster.values[i]) continue;
        all += 1.0;
        planned += raster.planned[i] ? 1.0 : 0.0;
    }
    return planned / all;
}

}  // namespace

SpherePlot plot_sphere(const std::filesystem::path& file, const Body& body) {
    const Matrix3d principal = principal_axes(body.moments);
    Sphere sphere{body, main_reynolds_number(*body.tables, case_records(*body.tables)), {}};
    sphere.axes << principal.col(1), principal.col(2), principal.col(0);
    SpherePlot shown;
    shown.reynolds_number = sphere.reynolds_number;
    std::string data = bar_data() + grid_data();
    shown.cases = add_cases(sphere, data);
    std::string plots;
    for (std::size_t number = 0; number < std::size(layers); ++number) {
        const Raster raster = raster_of(sphere, layers[number]);
        shown.planned = planned_share(raster);
        data += raster_data(fmt::format("$layer{}", number), raster);
        plots += layer_plot(number, raster, shown.cases > 0);
    }
    std::string below =
        "over all directions of motion  ·  middle: along the long axis, poles: along the short";
    const Symmetry& symmetry = body.symmetry;
    const bool has_images = symmetry.elements.size() > 1 || symmetry.kind != Symmetry::Kind::finite;
    if (shown.cases > 0)
        below += has_images ? "  ·  dots: solved, their images by symmetry" : "  ·  dots: solved";
    if (shown.planned < 1.0) below += "  ·  pale: extrapolated";
    draw_picture(file, data + "set multiplot\n" +
                           heading({body.name,
                                    fmt::format(": tables at Reynolds number {:.6g}", sphere.reynolds_number),
                                    below}) +
                           plots + "unset multiplot\nset output\n");
    return shown;
}

}  // namespace samara
