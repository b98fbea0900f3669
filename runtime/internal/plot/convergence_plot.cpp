#include "samara/internal/plot/convergence_plot.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "samara/analysis/verdicts/case_records.hpp"
#include "samara/internal/plot/body_picture.hpp"
#include "samara/internal/plot/gnuplot.hpp"
#include "samara/internal/plot/heading.hpp"
#include "samara/internal/plot/panel.hpp"

namespace samara {
namespace {

/// One direction on its meshes, coarsest first.
using Ladder = std::vector<CaseRecord>;

/// The ladders of the main Reynolds number with the closure of the table's cases that go to the last mesh.
std::vector<Ladder> ladders_of(const std::vector<CaseRecord>& records, double reynolds_number) {
    std::vector<Ladder> ladders;
    for (const CaseRecord& record : records) {
        if (!is_on_last_meshes(record) || record.reynolds_number != reynolds_number || !(record.cells > 0.0))
            continue;
        const auto known = std::ranges::find_if(ladders, [&](const Ladder& ladder) {
            return (ladder.front().direction - record.direction).norm() < same_direction;
        });
        if (known == ladders.end()) {
            ladders.push_back({record});
        } else {
            known->push_back(record);
        }
    }
    std::erase_if(ladders, [](const Ladder& ladder) {
        return std::ranges::none_of(ladder, [](const CaseRecord& one) { return one.purpose == "table"; });
    });
    for (Ladder& ladder : ladders) std::ranges::sort(ladder, {}, &CaseRecord::cells);
    return ladders;
}

std::string message_panel(const Box& box, const std::string& title, const std::string& message) {
    return bold_label(title, box.left, box.top + canvas::header_lift, "left", black) +
           label(message, box.left, 0.5 * (box.bottom + box.top), "left", gray) + place_frame(box) +
           "unset border; unset tics; plot [0:1] [0:1] NaN notitle\n" +
           "set border 3; set xtics; set ytics; unset label\n";
}

/// Tics at 1, 2 and 5 times powers of ten in the range, on an axis that is logarithmic.
std::string log_axis(const Range& range) {
    std::string tics;
    const auto lowest = static_cast<int>(std::floor(std::log10(range.low)));
    const auto highest = static_cast<int>(std::floor(std::log10(range.high)));
    for (int exponent = lowest; exponent <= highest; ++exponent) {
        const double power = std::pow(10.0, exponent);
        for (const double factor : {1.0, 2.0, 5.0}) {
            const double number = factor * power;
            // One at the very end would leave the picture.
            if (number < range.low || number > range.high / 1.1) continue;
            tics +=
                fmt::format("{}'{}' {:.9g}", tics.empty() ? "" : ", ", fmt::format("{:g}", number), number);
        }
    }
    return fmt::format("set logscale x; set xrange [{:.9g}:{:.9g}]; set xtics ({})\n", range.low, range.high,
                       tics);
}

constexpr const char* linear_axis = "unset logscale x; set xtics autofreq\n";

Range airy_log_range(const std::vector<double>& values) {
    const auto [low, high] = std::ranges::minmax(values);
    const double factor = std::max(1.35, std::pow(high / low, 0.08));
    // At least a factor of five, so that the axis has two numbers.
    const double more = std::max(1.0, std::sqrt(5.0 * low / high));
    return {low / factor / more, high * factor * more};
}

PanelText ladder_panel(const std::vector<Ladder>& ladders, const Box& box, const std::string& name,
                       const std::string& title, std::optional<double> (*value)(const CaseRecord&)) {
    PanelText text;
    std::vector<double> cells;
    std::vector<double> values = {0.0};
    std::string rows;
    for (const Ladder& ladder : ladders) {
        for (const CaseRecord& record : ladder) {
            const auto number = value(record);
            if (!number) continue;
            rows += fmt::format("{:.9g} {:.6g}\n", record.cells, *number);
            cells.push_back(record.cells);
            values.push_back(*number);
        }
        rows += '\n';
    }
    if (cells.empty()) {
        text.plots = message_panel(box, title, "the body file holds no such cases");
        return text;
    }
    text.data = fmt::format("${} << EOD\n{}EOD\n", name, rows);
    const Range range = airy_log_range(cells);
    text.plots = begin_panel(box, {range, "cells of the mesh", 1.0}, {airy_range(values), title, 0.0});
    text.plots += log_axis(range);
    text.plots += fmt::format(
        "plot ${0} using 1:2 with linespoints pt 7 ps 0.8*dot_size lw 2 lc rgb '#0072b2' notitle\n", name);
    text.plots += end_panel() + linear_axis;
    return text;
}

PanelText error_panel(const LoadTables& tables, const Box& box) {
    const std::string title = "Standard errors by source (%, rms)";
    PanelText text;
    if (tables.error_sources.empty()) {
        text.plots = message_panel(box, title, "the body file does not tell its errors' sources apart");
        return text;
    }
    constexpr struct {
        const char* name;
        double ErrorShare::*member;
    } quantities[] = {{"force", &ErrorShare::force},
                      {"moment", &ErrorShare::moment},
                      {"k", &ErrorShare::turbulent_kinetic_energy},
                      {"epsilon", &ErrorShare::dissipation_rate}};
    const double wide = 0.8 / static_cast<double>(tables.error_sources.size());
    std::vector<double> values = {0.0};
    std::string plot;
    std::string names;
    ColorKey key{box.right, box.bottom - 82.0};
    std::string sources;
    for (std::size_t i = tables.error_sources.size(); i-- > 0;) {
        const ErrorSource source = tables.error_sources[i].source;
        sources += key.add(name_of(source), body_colors[static_cast<std::size_t>(source)]);
    }
    for (std::size_t source = 0; source < tables.error_sources.size(); ++source) {
        const ErrorShare& share = tables.error_sources[source];
        text.data += fmt::format("$source{} << EOD\n", source);
        for (std::size_t i = 0; i < std::size(quantities); ++i) {
            const double value = 100.0 * share.*quantities[i].member;
            text.data += fmt::format(
                "{:.6g} {:.6g} {:.6g}\n",
                static_cast<double>(i) - 0.4 + wide * (static_cast<double>(source) + 0.5), value, 0.9 * wide);
            values.push_back(value);
        }
        text.data += "EOD\n";
        plot += fmt::format("{}$source{} using 1:2:3 with boxes fs solid 1 noborder lc rgb '#{:06x}' notitle",
                            source == 0 ? "plot " : ", ", source,
                            body_colors[static_cast<std::size_t>(share.source)]);
    }
    for (std::size_t i = 0; i < std::size(quantities); ++i) {
        names += fmt::format("{}'{}' {}", i == 0 ? "" : ", ", quantities[i].name, i);
    }
    text.plots = begin_panel(box, {{-0.6, 3.6}, "", 1.0}, {airy_range(values), title, 0.0});
    text.plots += fmt::format("set format x '%s'; set xtics ({})\n", names) + sources + plot + '\n' +
                  end_panel() + linear_axis;
    return text;
}

PanelText reynolds_panel(const Body& body, const Box& box) {
    const LoadTables& tables = *body.tables;
    const Matrix3d axes = principal_axes(body.moments);
    const bool all_alike = body.symmetry.kind == Symmetry::Kind::spherical;
    PanelText text;
    std::vector<double> shown = {0.0};
    std::string plot;
    ColorKey key{box.right, box.top + canvas::header_lift};
    std::string words;
    for (int axis = all_alike ? 0 : 2; axis >= 0; --axis) {
        const unsigned color = body_colors[axis];
        text.data += fmt::format("$axis{} << EOD\n", axis);
        for (std::size_t i = 0; i < tables.reynolds_numbers.size(); ++i) {
            const double number = tables.reynolds_numbers[i];
            const Vector3d direction = axes.col(axis);
            const double drag = -look_up(tables, direction, number).force.dot(direction);
            const double error =
                tables.errors.empty()
                    ? 0.0
                    : look_up_error(tables, direction, number).force.cwiseProduct(direction).norm();
            // Bars beside each other, where all axes have the same numbers.
            text.data +=
                fmt::format("{:.6g} {:.6g} {:.6g}\n", number * std::pow(1.05, axis - 1), drag, error);
            shown.insert(shown.end(), {drag - error, drag + error});
        }
        text.data += "EOD\n";
        const std::string block = fmt::format("$axis{}", axis);
        plot += (plot.empty() ? "plot " : ", ") + error_bars(block, color);
        plot += fmt::format(", {} using 1:2 with linespoints pt 7 ps dot_size lw 2 lc rgb '#{:06x}' notitle",
                            block, color);
        constexpr const char* names[] = {"short", "middle", "long"};
        const std::string name = all_alike ? "any direction" : names[axis];
        words += key.add(name, color);
    }
    std::vector<double> numbers = tables.reynolds_numbers;
    const Range range = airy_log_range(numbers);
    text.plots = begin_panel(box, {range, "Reynolds number U L/ν", 1.0},
                             {airy_range(shown), "Drag along the axes", 0.0}) +
                 words + log_axis(range) + plot + '\n' + end_panel() + linear_axis;
    return text;
}

}  // namespace

ConvergencePlot plot_convergence(const std::filesystem::path& file, const Body& body) {
    const LoadTables& tables = *body.tables;
    const std::vector<CaseRecord> records = case_records(tables);
    const double reynolds_number = main_reynolds_number(tables, records);
    const std::vector<Ladder> ladders = ladders_of(records, reynolds_number);
    ConvergencePlot shown;
    std::set<double> meshes;
    for (const Ladder& ladder : ladders) {
        if (ladder.size() > 1) ++shown.directions;
        for (const CaseRecord& record : ladder) meshes.insert(record.cells);
    }
    shown.meshes = static_cast<int>(meshes.size());
    shown.sources = static_cast<int>(tables.error_sources.size());

    const PanelText panels[] = {
        ladder_panel(ladders, quarter(0, 0, true), "drag", "Drag coefficient",
                     [](const CaseRecord& record) { return std::optional(record.drag); }),
        reynolds_panel(body, quarter(1, 0, true)),
        ladder_panel(ladders, quarter(0, 1, true), "k", "Turbulent kinetic energy k/U²",
                     [](const CaseRecord& record) { return record.k; }),
        error_panel(tables, quarter(1, 1, true)),
    };
    std::string data;
    std::string plots;
    for (const PanelText& panel : panels) {
        data += panel.data;
        plots += panel.plots;
    }
    std::string text =
        heading({body.name, fmt::format(": convergence at Reynolds number {:.6g}", reynolds_number),
                 fmt::format("each line on the left: one direction on {} meshes", shown.meshes)});
    draw_picture(file, data + "set multiplot\n" + text + plots + "unset multiplot\nset output\n");
    return shown;
}

}  // namespace samara
