#include "samara/internal/plot/landing_plot.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/internal/plot/axis_scale.hpp"
#include "samara/internal/plot/gnuplot.hpp"
#include "samara/internal/plot/heading.hpp"
#include "samara/internal/plot/panel.hpp"
#include "samara/internal/plot/silhouette.hpp"
#include "samara/motion/inclination.hpp"
#include "samara/motion/measures.hpp"

namespace samara {
namespace {

constexpr Box map_box = {140.0, 1125.0, canvas::bottom, canvas::top};
constexpr double series_left = 1270.0;
constexpr double right_edge = canvas::width - 45.0;
constexpr double gap = 190.0;
constexpr std::size_t most_paths = 200;
constexpr std::size_t most_path_points = 240;
constexpr const char* model_color = "#d55e00";

/// Where one copy comes down in one run.
struct Place {
    int run;
    int copy;
    int frame;
    Vector3d position;  // m
    double value;       // s: time of landing; without a landing m: way descended
};

struct Places {
    std::vector<Place> all;
    bool landed = false;  // on the ground; else at the last frame
};

Places places_of(const Motion& motion, const BodyMotion& body) {
    Places landed{{}, true};
    Places last;
    const Vector3d down = down_direction(motion.gravity);
    for (int run = 0; run < motion.runs; ++run) {
        for (int copy = 0; copy < body.copies; ++copy) {
            const auto place = [&](int frame, double value) {
                return Place{run, copy, frame, motion.pose(body, run, frame, copy).position, value};
            };
            if (const auto frame = landing_frame(motion, body, run, copy)) {
                landed.all.push_back(place(*frame, motion.times[static_cast<std::size_t>(*frame)]));
            }
            const int end = motion.frames() - 1;
            const Vector3d way =
                motion.pose(body, run, end, copy).position - motion.pose(body, run, 0, copy).position;
            last.all.push_back(place(end, way.dot(down)));
        }
    }
    return landed.all.empty() ? last : landed;
}

LandingPlot figures_of(const Motion& motion, const BodyMotion& body, const Places& places) {
    LandingPlot figures;
    figures.samples = motion.runs * body.copies;
    figures.landed = places.landed ? static_cast<int>(places.all.size()) : 0;
    const auto count = static_cast<double>(places.all.size());
    for (const Place& place : places.all) figures.mean += place.position / count;
    std::vector<double> distances;
    double squares = 0.0;
    for (const Place& place : places.all) {
        const double square = (place.position - figures.mean).head<2>().squaredNorm();
        squares += square;
        distances.push_back(std::sqrt(square));
    }
    figures.spread = std::sqrt(squares / count);
    figures.median = percentile(distances, 50.0);
    return figures;
}

/// The values in order, each with the share (per cent of `samples`) up to it: rows of a distribution
/// function.
std::string distribution_data(const char* block, std::vector<double> values, std::size_t samples) {
    std::sort(values.begin(), values.end());
    fmt::memory_buffer data;
    auto out = std::back_inserter(data);
    fmt::format_to(out, "{} << EOD\n{:.7g} 0\n", block, values.front());
    for (std::size_t i = 0; i < values.size(); ++i) {
        fmt::format_to(out, "{:.7g} {:.5g}\n", values[i],
                       100.0 * static_cast<double>(i + 1) / static_cast<double>(samples));
    }
    fmt::format_to(out, "EOD\n");
    return fmt::to_string(data);
}

/// What the map shows (m) and the numbers along its sides.
struct Map {
    Range across;
    Range up;
    AxisScale x;
    AxisScale y;
};

std::string places_data(const Motion& motion, const BodyMotion& body, const Places& places, const Map& map) {
    fmt::memory_buffer data;
    auto out = std::back_inserter(data);
    double least = places.all.front().value;
    double most = least;
    for (const Place& place : places.all) {
        least = std::min(least, place.value);
        most = std::max(most, place.value);
    }
    fmt::format_to(out, "$places << EOD\n");
    for (const Place& place : places.all) {
        const double share = most > least ? (place.value - least) / (most - least) : 0.5;
        fmt::format_to(out, "{:.7g} {:.7g} {}\n", map.x.number(place.position.x()),
                       map.y.number(place.position.y()), packed(time_color(share)));
    }
    fmt::format_to(out, "EOD\n$paths << EOD\n");
    const std::size_t stride = 1 + (places.all.size() - 1) / most_paths;
    for (std::size_t i = 0; i < places.all.size(); i += stride) {
        const Place& place = places.all[i];
        const int step = 1 + place.frame / static_cast<int>(most_path_points);
        for (int frame = place.frame % step; frame <= place.frame; frame += step) {
            const Vector3d& at = motion.pose(body, place.run, frame, place.copy).position;
            fmt::format_to(out, "{:.7g} {:.7g}\n", map.x.number(at.x()), map.y.number(at.y()));
        }
        fmt::format_to(out, "\n");
    }
    fmt::format_to(out, "EOD\n");
    return fmt::to_string(data);
}

/// The map around the places and their circle, with the box's proportions; no smaller than the body.
Map map_of(const BodyMotion& body, const LandingPlot& figures, const Places& places) {
    double radius = figures.spread;
    for (const Vector3d& vertex : body.surface.vertices) {
        radius = std::max(radius, (vertex - body.center_of_mass).norm());
    }
    if (!body.sizes.empty()) radius *= *std::max_element(body.sizes.begin(), body.sizes.end());
    std::vector<double> x = {figures.mean.x() - radius, figures.mean.x() + radius};
    std::vector<double> y = {figures.mean.y() - radius, figures.mean.y() + radius};
    for (const Place& place : places.all) {
        x.push_back(place.position.x());
        y.push_back(place.position.y());
    }
    Map map{airy_range(x), airy_range(y), {}, {}};
    const double wide = map_box.right - map_box.left;
    const double tall = map_box.top - map_box.bottom;
    const double pixel = std::max(map.across.size() / wide, map.up.size() / tall);
    const auto grow = [](Range& range, double size) {
        const double middle = 0.5 * (range.low + range.high);
        range = {middle - 0.5 * size, middle + 0.5 * size};
    };
    grow(map.across, pixel * wide);
    grow(map.up, pixel * tall);
    map.x = axis_scale(map.across, wide, across_least, 100.0);
    map.y = axis_scale(map.up, tall, up_least, 100.0);
    return map;
}

std::string map_plot(const LandingPlot& figures, const Places& places, const Map& map) {
    std::string plot = begin_panel(map_box, {map.x.numbers(map.across), map.x.title("x"), 0.0},
                                   {map.y.numbers(map.up), map.y.title("y") + ", from above", 0.0},
                                   places.landed ? "dark: first to land" : "dark: least descended");
    plot += fmt::format(
        "set object 1 circle at {0:.9g},{1:.9g} size {2:.9g} front fs empty border lc rgb '{3}' lw 3\n"
        "plot $paths using 1:2 with lines lw 1 lc rgb '#d0d0d0' notitle, $places using 1:2:3 with points pt "
        "7 "
        "ps 0.8*dot_size lc rgb variable notitle, '+' using ({0:.9g}):({1:.9g}) every ::0::0 with points pt "
        "1 "
        "ps 2.5*dot_size lw 4 lc rgb '{3}' notitle\n",
        map.x.number(figures.mean.x()), map.y.number(figures.mean.y()), figures.spread / map.x.unit,
        model_color);
    return plot + end_panel();
}

Box right_box(bool upper) {
    const double tall = 0.5 * (canvas::top - canvas::bottom - gap);
    const double bottom = upper ? canvas::top - tall : canvas::bottom;
    return {series_left, right_edge, bottom, bottom + tall};
}

std::string distance_plot(const LandingPlot& figures, double farthest) {
    std::string plot = begin_panel(
        right_box(true), {{0.0, std::max(1.05 * farthest, 1e-9)}, "distance from the mean (m)", 0.0},
        {{0.0, 100.0}, "Places within (%)", 0.0});
    plot += bold_label("normal", right_edge, canvas::top + canvas::header_lift, "right", 0xd55e00);
    plot += fmt::format(
        "set samples 300\n"
        "plot $distances using 1:2 with steps lw 3 lc rgb '#333333' notitle, 100*(1 - exp(-(x/{:.9g})**2)) "
        "with lines lw 2.5 dt (8,6) lc rgb '{}' notitle\n",
        std::max(figures.spread, 1e-12), model_color);
    return plot + end_panel();
}

std::string value_plot(const Places& places, const std::vector<double>& values) {
    const std::string title = places.landed ? "time of landing (s)" : "way descended (m)";
    const std::string heading = places.landed ? "Landed by, of all (%)" : "Descended less (%)";
    std::string plot =
        begin_panel(right_box(false), {airy_range(values), title, 0.0}, {{0.0, 100.0}, heading, 0.0});
    plot += "plot $values using 1:2 with steps lw 3 lc rgb '#333333' notitle\n";
    return plot + end_panel();
}

std::string title_of(const Motion& motion, const BodyMotion& body, const LandingPlot& figures) {
    const std::string title =
        figures.landed > 0 ? fmt::format(": {} of {} landed, spread {:.3g} m", figures.landed,
                                         figures.samples, figures.spread)
                           : fmt::format(": {} in the air, spread {:.3g} m", figures.samples, figures.spread);
    std::string below;
    if (motion.runs > 1) below += fmt::format("{} runs  ·  ", motion.runs);
    if (body.copies > 1) below += fmt::format("{} copies  ·  ", body.copies);
    below += fmt::format("half within {:.3g} m of the mean ({:.3g}, {:.3g}) m", figures.median,
                         figures.mean.x(), figures.mean.y());
    if (figures.landed == 0) below += fmt::format("  ·  at {:.2f} s", motion.times.back());
    return heading({body.name, title, below});
}

}  // namespace

LandingPlot plot_landing(const std::filesystem::path& file, const Motion& motion, const BodyMotion& body) {
    const Places places = places_of(motion, body);
    if (places.all.size() < 2) {
        throw Error(
            fmt::format("'{}': a landing map needs more than one {}: simulate with --runs N, or a count in "
                        "the scene",
                        body.name, places.landed ? "landing" : "fall"));
    }
    const LandingPlot figures = figures_of(motion, body, places);
    std::vector<double> distances;
    std::vector<double> values;
    for (const Place& place : places.all) {
        distances.push_back((place.position - figures.mean).head<2>().norm());
        values.push_back(place.value);
    }
    const double farthest = *std::max_element(distances.begin(), distances.end());
    const Map map = map_of(body, figures, places);
    std::string script = places_data(motion, body, places, map);
    script += distribution_data("$distances", distances, distances.size());
    script += distribution_data("$values", values, static_cast<std::size_t>(figures.samples));
    script += "set multiplot\n" + title_of(motion, body, figures) + map_plot(figures, places, map);
    script += distance_plot(figures, farthest) + value_plot(places, values);
    draw_picture(file, script + "unset multiplot\nset output\n");
    return figures;
}

}  // namespace samara
