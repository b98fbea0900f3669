#include "samara/internal/plot/polar_plot.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "samara/analysis/verdicts/case_records.hpp"
#include "samara/core/base/angles.hpp"
#include "samara/internal/plot/body_arcs.hpp"
#include "samara/internal/plot/body_picture.hpp"
#include "samara/internal/plot/gnuplot.hpp"
#include "samara/internal/plot/heading.hpp"
#include "samara/internal/plot/panel.hpp"

namespace samara {
namespace {

constexpr int points_of_curve = 181;
constexpr int bars_of_curve = 9;

struct Quantity {
    const char* title;
    double ArcValues::*member;
    double least;                                         // that the axis reaches: below, it is noise
    std::optional<double> (*of_case)(const CaseRecord&);  // null: cases do not say
};

constexpr Quantity quantities[] = {
    {"Drag coefficient", &ArcValues::drag, 0.01,
     [](const CaseRecord& record) { return std::optional(record.drag); }},
    {"Lift coefficient, towards growing angles", &ArcValues::lift, 0.01, nullptr},
    {"Moment coefficient, about the plane's normal", &ArcValues::moment, 0.01, nullptr},
    {"Turbulent kinetic energy k/U²", &ArcValues::k, 1e-4, [](const CaseRecord& record) { return record.k; }},
};

struct Polars {
    const Body& body;
    double reynolds_number;
    std::vector<CaseRecord> cases;  // of this Reynolds number, on the finest mesh
    std::vector<BodyArc> arcs;
    double most;  // degrees
};

/// The cases that went into the table at the Reynolds number.
std::vector<CaseRecord> table_cases(std::vector<CaseRecord> records, double reynolds_number) {
    std::erase_if(records, [&](const CaseRecord& record) {
        return record.purpose != "table" || record.reynolds_number != reynolds_number;
    });
    return records;
}

Polars polars_of(const Body& body) {
    const std::vector<CaseRecord> records = case_records(*body.tables);
    const double reynolds_number = main_reynolds_number(*body.tables, records);
    const std::vector<BodyArc> arcs = arcs_of(body, reynolds_number);
    return {body, reynolds_number, table_cases(records, reynolds_number), arcs,
            shown_angle(*body.tables, arcs, reynolds_number)};
}

std::string block_name(const char* kind, std::size_t quantity, std::size_t arc) {
    return fmt::format("${}_{}_{}", kind, quantity, arc);
}

/// Data blocks of one curve: the curve, bars at even angles (each arc's between the others'), solved cases.
/// All values that have to fit into the panel are added to `shown`.
std::string curve_data(const Polars& polars, std::size_t quantity, std::size_t number,
                       std::vector<double>& shown) {
    const auto& [title, member, least, of_case] = quantities[quantity];
    const BodyArc& arc = polars.arcs[number];
    const LoadTables& tables = *polars.body.tables;
    std::string data = block_name("curve", quantity, number) + " << EOD\n";
    for (int i = 0; i < points_of_curve; ++i) {
        const double angle = polars.most * i / (points_of_curve - 1);
        const double value = values_on(tables, arc, angle / degrees, polars.reynolds_number).*member;
        data += fmt::format("{:.6g} {:.6g}\n", angle, value);
        shown.push_back(value);
    }
    data += "EOD\n" + block_name("bars", quantity, number) + " << EOD\n";
    for (int i = 0; i < bars_of_curve; ++i) {
        const double share = (static_cast<double>(number) + 0.5) / static_cast<double>(polars.arcs.size());
        const double angle = polars.most * (i + share) / bars_of_curve;
        const double value = values_on(tables, arc, angle / degrees, polars.reynolds_number).*member;
        const double error = errors_on(tables, arc, angle / degrees, polars.reynolds_number).*member;
        data += fmt::format("{:.6g} {:.6g} {:.6g}\n", angle, value, error);
        shown.insert(shown.end(), {value - error, value + error});
    }
    data += "EOD\n" + block_name("solved", quantity, number) + " << EOD\n";
    for (const CaseRecord& record : polars.cases) {
        const auto value = of_case ? of_case(record) : std::nullopt;
        if (!value) continue;
        for (const double angle : angles_on(arc, polars.body.symmetry, record.direction, polars.most)) {
            data += fmt::format("{:.6g} {:.6g}\n", angle, *value);
            shown.push_back(*value);
        }
    }
    return data + "EOD\n";
}

bool has_cases(const Polars& polars, std::size_t quantity, std::size_t arc) {
    return quantities[quantity].of_case != nullptr &&
           std::ranges::any_of(polars.cases, [&](const CaseRecord& record) {
               return quantities[quantity].of_case(record) &&
                      !angles_on(polars.arcs[arc], polars.body.symmetry, record.direction, polars.most)
                           .empty();
           });
}

PanelText quantity_panel(const Polars& polars, std::size_t quantity) {
    PanelText text;
    std::vector<double> shown = {0.0, quantities[quantity].least};
    for (std::size_t arc = 0; arc < polars.arcs.size(); ++arc) {
        text.data += curve_data(polars, quantity, arc, shown);
    }
    const Box box = quarter(static_cast<int>(quantity % 2), static_cast<int>(quantity / 2), false);
    const bool lowest = quantity >= 2;
    text.plots =
        begin_panel(box, {{0.0, polars.most}, lowest ? "direction of motion (°)" : "", polars.most / 6},
                    {airy_range(shown), quantities[quantity].title, 0.0});
    std::string plot;
    const auto add = [&](const std::string& curve) { plot += (plot.empty() ? "plot " : ", ") + curve; };
    for (std::size_t arc = 0; arc < polars.arcs.size(); ++arc) {
        const unsigned color = body_colors[arc];
        add(error_bars(block_name("bars", quantity, arc), color));
        add(fmt::format("{} using 1:2 with lines lw 3 lc rgb '#{:06x}' notitle",
                        block_name("curve", quantity, arc), color));
        if (!has_cases(polars, quantity, arc)) continue;
        add(fmt::format("{} using 1:2 with points pt 7 ps dot_size lc rgb '#{:06x}' notitle",
                        block_name("solved", quantity, arc), color));
    }
    text.plots += plot + '\n' + end_panel();
    return text;
}

int solved_on_arcs(const Polars& polars) {
    return static_cast<int>(std::ranges::count_if(polars.cases, [&](const CaseRecord& record) {
        return std::ranges::any_of(polars.arcs, [&](const BodyArc& arc) {
            return !angles_on(arc, polars.body.symmetry, record.direction, polars.most).empty();
        });
    }));
}

std::string heading_of(const Polars& polars) {
    std::string text =
        heading({polars.body.name, fmt::format(": polars at Reynolds number {:.6g}", polars.reynolds_number),
                 "0°: along the first axis  ·  bars: standard errors  ·  dots: solved cases"});
    ColorKey key;
    for (std::size_t arc = polars.arcs.size(); arc-- > 0;) {
        text += key.add(polars.arcs.size() == 1 && polars.body.symmetry.kind == Symmetry::Kind::spherical
                            ? "any plane"
                            : polars.arcs[arc].name,
                        body_colors[arc]);
    }
    return text;
}

}  // namespace

PolarPlot plot_polars(const std::filesystem::path& file, const Body& body) {
    const Polars polars = polars_of(body);
    std::string data;
    std::string plots;
    for (std::size_t quantity = 0; quantity < std::size(quantities); ++quantity) {
        const PanelText panel = quantity_panel(polars, quantity);
        data += panel.data;
        plots += panel.plots;
    }
    draw_picture(file,
                 data + "set multiplot\n" + heading_of(polars) + plots + "unset multiplot\nset output\n");
    return {static_cast<int>(polars.arcs.size()), solved_on_arcs(polars), polars.most,
            polars.reynolds_number};
}

}  // namespace samara
