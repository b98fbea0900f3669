#include "converter/tables/table_filling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "converter/tables/fitted_tables.hpp"
#include "converter/tables/model_errors.hpp"
#include "converter/tables/reynolds_fit.hpp"
#include "converter/tables/symmetric_loads.hpp"
#include "samara/core/surface/octahedral_map.hpp"

namespace samara {
namespace {

/// Variances by source; those of k and epsilon are of their logarithms.
using SourceVariances = std::array<LoadEntryError, error_source_count>;

LoadEntryError& of(SourceVariances& variances, ErrorSource source) {
    return variances[static_cast<std::size_t>(source)];
}

const LoadEntryError& of(const SourceVariances& variances, ErrorSource source) {
    return variances[static_cast<std::size_t>(source)];
}

/// Returns the variance of each component, and of turbulence in_fit_units(), by standard errors that are
/// equal for all free components.
LoadEntryError variance_of(const ErrorMetrics& metrics, const FreeComponents& free) {
    return {metrics.force * metrics.force * free.force, metrics.moment * metrics.moment * free.moment,
            metrics.turbulent_kinetic_energy * metrics.turbulent_kinetic_energy,
            metrics.dissipation_rate * metrics.dissipation_rate};
}

/// Converts variances to standard errors, those of turbulence from in_fit_units() to k and epsilon.
LoadEntryError absolute(const LoadEntry& entry, const LoadEntryError& variance) {
    LoadEntryError error = rooted(variance);
    const auto of_square = [](double square, double of_root) {
        return (2.0 * std::sqrt(square) + of_root) * of_root;
    };
    error.turbulent_kinetic_energy =
        of_square(entry.turbulent_kinetic_energy, error.turbulent_kinetic_energy);
    error.dissipation_rate = of_square(entry.dissipation_rate, error.dissipation_rate);
    return error;
}

/// Calls visit(row, column) for each element of a square; the map has 2 subdivisions + 1 nodes on each side,
/// and one cell fewer.
template <typename Visit>
void for_each(int side, const Visit& visit) {
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) visit(row, column);
    }
}

std::size_t node_index(int subdivisions, int row, int column) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(2 * subdivisions + 1) +
           static_cast<std::size_t>(column);
}

void fill_nodes(ReynoldsTable& table, int subdivisions) {
    double force = 0.0;
    double moment = 0.0;
    double k = 0.0;
    double epsilon = 0.0;
    double directions = 0.0;
    for_each(2 * subdivisions + 1, [&](int row, int column) {
        const LoadEntry entry = table.fit->at(octahedral_node(subdivisions, row, column));
        const std::size_t here = node_index(subdivisions, row, column);
        table.nodes.push_back(entry);
        if (unique_node(subdivisions, row, column) != here) return;
        force += entry.force.squaredNorm();
        moment += entry.moment.squaredNorm();
        k += entry.turbulent_kinetic_energy;
        epsilon += entry.dissipation_rate;
        directions += 1.0;
    });
    const auto rms = [&](double sum) { return std::sqrt(sum / directions); };
    table.scale.rms = {rms(force), rms(moment), rms(k), rms(epsilon)};
}

/// Returns the variance by the interpolation at the centre of a cell.
LoadEntryError variance_in_cell(const ReynoldsTable& table, const Symmetry& symmetry, int subdivisions,
                                int row, int column) {
    const double middle = 0.5;
    const Vector3d center =
        octahedral_direction({(column + middle) / subdivisions - 1.0, (row + middle) / subdivisions - 1.0});
    LoadEntry bilinear;
    for (const auto& [down, right] : {std::pair{0, 0}, {0, 1}, {1, 0}, {1, 1}}) {
        bilinear = plus(bilinear, 0.25, table.nodes[node_index(subdivisions, row + down, column + right)]);
    }
    const LoadEntry lookup = plus(in_fit_units(bilinear), -1.0, in_fit_units(table.fit->at(center)));
    return plus(variance_of(table.fit->interpolation_error(center), free_components(symmetry, center)), 1.0,
                squared(lookup));
}

/// Returns the mean variances of the cells around each node, row by row.
std::vector<LoadEntryError> variances_around_nodes(const ReynoldsTable& table, const Symmetry& symmetry,
                                                   int subdivisions) {
    std::vector<LoadEntryError> sums(table.nodes.size());
    std::vector<double> cells(table.nodes.size(), 0.0);
    for_each(2 * subdivisions, [&](int row, int column) {
        const LoadEntryError variance = variance_in_cell(table, symmetry, subdivisions, row, column);
        for (const auto& [down, right] : {std::pair{0, 0}, {0, 1}, {1, 0}, {1, 1}}) {
            const std::size_t node = unique_node(subdivisions, row + down, column + right);
            sums[node] = plus(sums[node], 1.0, variance);
            cells[node] += 1.0;
        }
    });
    std::vector<LoadEntryError> means;
    for_each(2 * subdivisions + 1, [&](int row, int column) {
        const std::size_t node = unique_node(subdivisions, row, column);
        means.push_back(plus({}, 1.0 / cells[node], sums[node]));
    });
    return means;
}

LoadEntryError model_variance(const RelativeErrors& errors, const LoadEntry& entry, const LoadScale& scale,
                              const FreeComponents& free) {
    const ErrorMetrics size = scale.at(in_fit_units(entry));
    return variance_of({errors.force * size.force, errors.moment * size.moment,
                        errors.turbulent_kinetic_energy * size.turbulent_kinetic_energy,
                        errors.dissipation_rate * size.dissipation_rate},
                       free);
}

/// The model errors of the whole tables, where the cases show them.
struct ModelErrors {
    std::optional<RelativeErrors> mesh;
    std::optional<RelativeErrors> closure;
};

std::vector<SourceVariances> source_variances(const ReynoldsTable& table, const Symmetry& symmetry,
                                              const ModelErrors& model,
                                              const LoadEntryError& between_reynolds_numbers,
                                              int subdivisions) {
    const std::vector<LoadEntryError> interpolation = variances_around_nodes(table, symmetry, subdivisions);
    std::vector<SourceVariances> result(table.nodes.size());
    const std::vector<Vector3d> directions = octahedral_nodes(subdivisions);
    for (std::size_t node = 0; node < directions.size(); ++node) {
        const Vector3d& direction = directions[node];
        SourceVariances& variances = result[node];
        of(variances, ErrorSource::tail) = squared(table.fit->error_at(table.tail, direction));
        of(variances, ErrorSource::symmetry) = squared(table.fit->error_at(table.asymmetry, direction));
        const LoadEntry& entry = table.nodes[node];
        const FreeComponents free = free_components(symmetry, direction);
        const auto of_model = [&](const std::optional<RelativeErrors>& errors) {
            return errors ? model_variance(*errors, entry, table.scale, free) : LoadEntryError{};
        };
        of(variances, ErrorSource::mesh) = of_model(model.mesh);
        of(variances, ErrorSource::closure) = of_model(model.closure);
        of(variances, ErrorSource::interpolation) = plus(interpolation[node], 1.0, between_reynolds_numbers);
    }
    return result;
}

/// Sums of squares over the whole tables: of the values, and of their errors by source.
struct Totals {
    LoadEntry values;
    SourceVariances errors;
};

void add(Totals& totals, const LoadEntry& entry, const SourceVariances& variances) {
    totals.values = plus(totals.values, 1.0, squared(entry));
    for (std::size_t source = 0; source < variances.size(); ++source) {
        totals.errors[source] = plus(totals.errors[source], 1.0, squared(absolute(entry, variances[source])));
    }
}

double root_ratio(double squares, double of_squares) {
    return of_squares > 0.0 ? std::sqrt(squares / of_squares) : 0.0;
}

std::vector<ErrorShare> shares_of(const Totals& totals, const ModelErrors& model, bool has_symmetry) {
    std::vector<ErrorShare> shares;
    for (std::size_t i = 0; i < error_source_count; ++i) {
        const auto source = static_cast<ErrorSource>(i);
        if (source == ErrorSource::mesh && !model.mesh) continue;
        if (source == ErrorSource::closure && !model.closure) continue;
        if (source == ErrorSource::symmetry && !has_symmetry) continue;
        const LoadEntryError& error = totals.errors[i];
        const LoadEntry& value = totals.values;
        shares.push_back({source, root_ratio(error.force.sum(), value.force.sum()),
                          root_ratio(error.moment.sum(), value.moment.sum()),
                          root_ratio(error.turbulent_kinetic_energy, value.turbulent_kinetic_energy),
                          root_ratio(error.dissipation_rate, value.dissipation_rate)});
    }
    return shares;
}

bool forbids_something(const Symmetry& symmetry, const std::vector<ReynoldsTable>& tables) {
    return std::any_of(tables.begin(), tables.end(), [&](const ReynoldsTable& table) {
        return std::any_of(table.samples.begin(), table.samples.end(), [&](const DirectionSample& sample) {
            const AllowedComponents allowed = allowed_components(symmetry, sample.direction);
            return allowed.force + allowed.moment < 6;
        });
    });
}

ModelErrors errors_of_models(const Symmetry& symmetry, const std::vector<SolvedCase>& cases,
                             const std::vector<ReynoldsTable>& tables) {
    std::vector<double> reynolds_numbers;
    std::vector<LoadScale> scales;
    for (const ReynoldsTable& table : tables) {
        reynolds_numbers.push_back(table.reynolds_number);
        scales.push_back(table.scale);
    }
    const auto errors = [&](CasePurpose purpose) {
        return model_errors(purpose, symmetry, cases, reynolds_numbers, scales);
    };
    return {errors(CasePurpose::mesh), errors(CasePurpose::closure)};
}

LoadEntryError variance_between(const std::vector<ReynoldsTable>& tables) {
    std::vector<double> reynolds_numbers;
    std::vector<std::vector<LoadEntry>> nodes;
    for (const ReynoldsTable& table : tables) {
        reynolds_numbers.push_back(table.reynolds_number);
        nodes.push_back(table.nodes);
    }
    return reynolds_interpolation_variance(reynolds_numbers, nodes);
}

}  // namespace

std::vector<LoadEntryError> fill_tables(LoadTables& tables, const Symmetry& symmetry,
                                        std::vector<SolvedCase>& cases, double main_reynolds_number,
                                        const std::optional<SurfaceLoads>& surface) {
    FittedTables fitted = fitted_tables(symmetry, cases, main_reynolds_number, surface);
    std::vector<ReynoldsTable>& parts = fitted.tables;
    for (ReynoldsTable& part : parts) fill_nodes(part, tables.subdivisions);
    const ModelErrors model = errors_of_models(symmetry, cases, parts);
    const LoadEntryError between = variance_between(parts);
    Totals totals;
    std::vector<LoadEntryError> sampling;
    for (const ReynoldsTable& part : parts) {
        tables.reynolds_numbers.push_back(part.reynolds_number);
        const std::vector<SourceVariances> variances =
            source_variances(part, symmetry, model, between, tables.subdivisions);
        for (std::size_t node = 0; node < part.nodes.size(); ++node) {
            const LoadEntry& entry = part.nodes[node];
            LoadEntryError sum;
            for (std::size_t i = 0; i < error_source_count; ++i) {
                LoadEntryError variance = variances[node][i];
                // The spread of closures is no error of the numbers, and no finer bake lowers it.
                if (static_cast<ErrorSource>(i) == ErrorSource::closure) {
                    variance.turbulent_kinetic_energy = variance.dissipation_rate = 0.0;
                }
                sum = plus(sum, 1.0, variance);
            }
            tables.entries.push_back(transformed(entry, tables.axes));
            tables.errors.push_back(transformed_error(absolute(entry, sum), tables.axes));
            const LoadEntryError of_sampling = of(variances[node], ErrorSource::interpolation);
            sampling.push_back(transformed_error(absolute(entry, of_sampling), tables.axes));
            add(totals, entry, variances[node]);
        }
    }
    tables.error_sources = shares_of(totals, model, forbids_something(symmetry, parts));
    return sampling;
}

namespace {

/// The error in the middle of an interval relative to that of an interval twice as long, for second order.
constexpr double share_left = 0.25;

}  // namespace

LoadEntryError reynolds_interpolation_variance(const std::vector<double>& reynolds_numbers,
                                               const std::vector<std::vector<LoadEntry>>& nodes) {
    LoadEntryError sum;
    double count = 0.0;
    double turbulent = 0.0;
    for (std::size_t i = 1; i + 1 < reynolds_numbers.size(); ++i) {
        const double below = std::log(reynolds_numbers[i] / reynolds_numbers[i - 1]);
        const double above = std::log(reynolds_numbers[i + 1] / reynolds_numbers[i]);
        const double fraction = below / (below + above);
        for (std::size_t node = 0; node < nodes[i].size(); ++node) {
            const LoadEntry& lower = nodes[i - 1][node];
            const LoadEntry& upper = nodes[i + 1][node];
            const LoadEntry lookup = plus(plus({}, 1.0 - fraction, lower), fraction, upper);
            LoadEntry error = plus(in_fit_units(lookup), -1.0, in_fit_units(nodes[i][node]));
            const bool all = is_turbulent(lower) && is_turbulent(nodes[i][node]) && is_turbulent(upper);
            if (!all) error.turbulent_kinetic_energy = error.dissipation_rate = 0.0;
            sum = plus(sum, 1.0, squared(error));
            count += 1.0;
            if (all) turbulent += 1.0;
        }
    }
    if (count == 0.0) return {};
    const double square = share_left * share_left;
    const double of_turbulence = turbulent > 0.0 ? square / turbulent : 0.0;
    return {Vector3d::Constant(square * sum.force.mean() / count),
            Vector3d::Constant(square * sum.moment.mean() / count),
            of_turbulence * sum.turbulent_kinetic_energy, of_turbulence * sum.dissipation_rate};
}

}  // namespace samara
