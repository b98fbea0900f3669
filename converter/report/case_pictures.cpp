#include "converter/report/case_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "samara/internal/plot/body_picture.hpp"
#include "samara/internal/plot/gnuplot.hpp"
#include "samara/internal/plot/heading.hpp"
#include "samara/internal/plot/panel.hpp"

namespace samara {
namespace {

constexpr std::size_t most_points = 200;  // of a curve
constexpr double settling_start = 0.1;    // share of a history that may leave the panel

/// The panel of one of so many meshes.
Box mesh_box(std::size_t number, std::size_t count) {
    const auto column = static_cast<int>(number % 2);
    if (count > 2) return quarter(column, static_cast<int>(number / 2), true);
    Box box = quarter(column, 0, true);
    box.bottom = canvas::bottom;
    if (count == 1) box.right = quarter(1, 0, true).right;
    return box;
}

void add_pieces(fmt::memory_buffer& data, const std::string& block,
                const std::vector<MeshSection::Piece>& pieces) {
    auto out = std::back_inserter(data);
    fmt::format_to(out, "${} << EOD\n", block);
    for (const auto& [from, to] : pieces) {
        fmt::format_to(out, "{:.4g} {:.4g}\n{:.4g} {:.4g}\n\n", from.x(), from.y(), to.x(), to.y());
    }
    fmt::format_to(out, "EOD\n");
}

std::string lines_of(const char* kind, std::size_t number, const char* style) {
    return fmt::format("${}{} using 1:2 with lines {} notitle", kind, number, style);
}

struct Series {
    const char* title;
    const std::vector<double> CaseHistory::*iterations;
    const std::vector<double> CaseHistory::*values;
    bool logarithmic = false;
};

const Series all_series[] = {
    {"Drag coefficient", &CaseHistory::iterations, &CaseHistory::drag},
    {"Moment coefficient, its size", &CaseHistory::iterations, &CaseHistory::moment},
    {"k/U² of the shell", &CaseHistory::iterations, &CaseHistory::k},
    {"Residual of the pressure, last round", &CaseHistory::residual_iterations, &CaseHistory::residuals,
     true},
};

/// The range of what counts: without the first iterations, in which a flow starts.
Range settled_range(const std::vector<CaseHistory>& cases, const Series& series) {
    std::vector<double> shown;
    if (!series.logarithmic) shown.push_back(0.0);
    for (const CaseHistory& one : cases) {
        const std::vector<double>& values = one.*series.values;
        const auto first = static_cast<std::size_t>(settling_start * static_cast<double>(values.size()));
        for (std::size_t i = first; i < values.size(); ++i) {
            if (series.logarithmic && !(values[i] > 0.0)) continue;
            shown.push_back(series.logarithmic ? std::log10(values[i]) : values[i]);
        }
    }
    if (shown.empty()) return {0.0, 1.0};
    Range range = airy_range(shown);
    if (!series.logarithmic) return range;
    return {std::floor(range.low), std::max(std::ceil(range.high), std::floor(range.low) + 2.0)};
}

std::string series_data(const std::vector<CaseHistory>& cases, const Series& series, std::size_t number,
                        const Range& range) {
    std::string data = fmt::format("$series{} << EOD\n", number);
    for (const CaseHistory& one : cases) {
        const std::vector<double>& values = one.*series.values;
        const std::vector<double>& iterations = one.*series.iterations;
        const std::size_t stride = 1 + values.size() / most_points;
        for (std::size_t i = 0; i < values.size(); i += stride) {
            const double value = series.logarithmic ? std::log10(std::max(values[i], 1e-300)) : values[i];
            // What leaves the panel ends the line.
            if (value < range.low || value > range.high) {
                data += '\n';
                continue;
            }
            data += fmt::format("{:.6g} {:.6g}\n", iterations[i], value);
        }
        data += '\n';
    }
    return data + "EOD\n";
}

PanelText series_panel(const std::vector<CaseHistory>& cases, std::size_t number) {
    const Series& series = all_series[number];
    const Box box = quarter(static_cast<int>(number % 2), static_cast<int>(number / 2), true);
    double first = 0.0;
    double last = 0.0;
    for (const CaseHistory& one : cases) {
        const std::vector<double>& iterations = one.*series.iterations;
        if (iterations.empty()) continue;
        first = last == 0.0 ? iterations.front() : std::min(first, iterations.front());
        last = std::max(last, iterations.back());
    }
    if (!(last > first)) {
        return {"", bold_label(series.title, box.left, box.top + canvas::header_lift, "left", black) +
                        label("not in the folder", box.left, 0.5 * (box.bottom + box.top), "left", gray) +
                        place_frame(box) + "unset border; unset tics; plot [0:1] [0:1] NaN notitle\n" +
                        "set border 3; set xtics; set ytics; unset label\n"};
    }
    const Range range = settled_range(cases, series);
    PanelText text;
    text.data = series_data(cases, series, number, range);
    text.plots = begin_panel(box, {{std::min(first, 0.97 * first), last}, "iteration", 0.0},
                             {range, series.title, series.logarithmic ? 1.0 : 0.0});
    if (series.logarithmic) text.plots += "set format y '10^{%g}'\n";
    text.plots +=
        fmt::format("plot $series{} using 1:2 with lines lw 1.2 lc rgb '#400072b2' notitle\n", number);
    text.plots += end_panel();
    return text;
}

}  // namespace

std::vector<double> mesh_panel_shape(std::size_t count) {
    const Box box = mesh_box(0, count);
    return {box.right - box.left, box.top - box.bottom};
}

void plot_meshes(const std::filesystem::path& file, const std::string& name, const std::string& plane,
                 const std::vector<DrawnMesh>& meshes) {
    fmt::memory_buffer data;
    std::string plots;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const DrawnMesh& mesh = meshes[i];
        add_pieces(data, fmt::format("cells{}", i), mesh.section.cells);
        add_pieces(data, fmt::format("surface{}", i), mesh.section.body);
        const Box box = mesh_box(i, meshes.size());
        plots += place_frame(box) + "unset border; unset tics; set clip two\n";
        plots += fmt::format("set xrange [{0}:{1}]; set yrange [{2}:{3}]\n", -mesh.half_width,
                             mesh.half_width, -mesh.half_height, mesh.half_height);
        plots += bold_label(mesh.title, box.left, box.top + canvas::header_lift, "left", black);
        plots += "plot " + lines_of("cells", i, "lw 0.8 lc rgb '#8795a3'");
        if (!mesh.section.body.empty()) plots += ", " + lines_of("surface", i, "lw 3 lc rgb '#d55e00'");
        plots += "\nunset label\n";
    }
    draw_picture(file, fmt::to_string(data) + "set multiplot\n" +
                           heading({name, ": the meshes around the body", plane}) + plots +
                           "unset multiplot\nset output\n");
}

void plot_histories(const std::filesystem::path& file, const std::string& name,
                    const std::vector<CaseHistory>& cases) {
    std::string data;
    std::string plots;
    for (std::size_t i = 0; i < std::size(all_series); ++i) {
        const PanelText panel = series_panel(cases, i);
        data += panel.data;
        plots += panel.plots;
    }
    draw_picture(
        file,
        data + "set multiplot\n" +
            heading({name, ": how its cases settled",
                     fmt::format("a line for each of {} cases  ·  their last halves count", cases.size())}) +
            plots + "unset multiplot\nset output\n");
}

}  // namespace samara
