#include "converter/tables/model_errors.hpp"

#include <algorithm>
#include <cmath>

#include "converter/tables/direction_sampling.hpp"
#include "converter/tables/standard_error.hpp"

namespace samara {
namespace {

/// Accumulates variances per component over directions.
class Variances {
  public:
    void add(double variance, int degrees) {
        sum_ += variance * degrees;
        degrees_ += degrees;
    }
    [[nodiscard]] bool empty() const { return degrees_ == 0; }
    /// Returns the root of their mean; for closures widened for the small number of directions.
    [[nodiscard]] double root(CasePurpose purpose) const {
        if (empty()) return 0.0;
        const double widening = purpose == CasePurpose::closure ? student_widening(degrees_) : 1.0;
        return widening * std::sqrt(sum_ / degrees_);
    }

  private:
    double sum_ = 0.0;
    int degrees_ = 0;
};

struct AllVariances {
    Variances force;
    Variances moment;
    Variances turbulent_kinetic_energy;
    Variances dissipation_rate;
};

/// Whether a case may be the base of a comparison: meshes are compared with the table's case, closures with
/// the case of the table's closure on their mesh.
bool is_base(const SolvedCase& base, CasePurpose purpose) {
    return base.purpose == CasePurpose::table ||
           (purpose == CasePurpose::closure && base.purpose == CasePurpose::mesh);
}

bool is_compared_with(const SolvedCase& base, const SolvedCase& other, double tolerance) {
    if (base.reynolds_number != other.reynolds_number) return false;
    if ((base.sample.direction - other.sample.direction).norm() > tolerance) return false;
    return other.purpose == CasePurpose::mesh ? base.closure == other.closure : base.mesh == other.mesh;
}

/// The table's entry and those of the cases that are compared with it, in_fit_units().
struct Group {
    LoadEntry table;
    std::vector<LoadEntry> others;
    bool turbulent = true;
};

Group group_of(const SolvedCase& table, CasePurpose purpose, const std::vector<SolvedCase>& cases,
               double tolerance) {
    Group group{in_fit_units(table.sample.entry), {}, is_turbulent(table.sample.entry)};
    for (const SolvedCase& other : cases) {
        if (other.purpose != purpose || !is_compared_with(table, other, tolerance)) continue;
        group.others.push_back(in_fit_units(other.sample.entry));
        group.turbulent = group.turbulent && is_turbulent(other.sample.entry);
    }
    return group;
}

/// Returns the variance with others.size() degrees of freedom: about the table's value for meshes, about the
/// mean of all for closures.
LoadEntry variance_of(const Group& group, CasePurpose purpose) {
    const auto count = static_cast<double>(group.others.size());
    LoadEntry center = group.table;
    if (purpose == CasePurpose::closure) {
        for (const LoadEntry& other : group.others) {
            center = plus(center, 1.0 / (count + 1.0), plus(other, -1.0, group.table));
        }
    }
    LoadEntry sum = squared(plus(group.table, -1.0, center));
    for (const LoadEntry& other : group.others) sum = plus(sum, 1.0, squared(plus(other, -1.0, center)));
    return plus({}, 1.0 / count, sum);
}

void add(AllVariances& all, const Group& group, const LoadEntry& variance, const AllowedComponents& allowed,
         const LoadScale& scale) {
    const auto degrees = static_cast<int>(group.others.size());
    const auto add_load = [&](Variances& sum, const Vector3d& squares, int components, double size) {
        if (components > 0 && size > 0.0) sum.add(squares.sum() / (components * size * size), degrees);
    };
    const ErrorMetrics size = scale.at(group.table);
    add_load(all.force, variance.force, allowed.force, size.force);
    add_load(all.moment, variance.moment, allowed.moment, size.moment);
    if (!group.turbulent) return;
    const auto add_scalar = [&](Variances& sum, double square, double of) {
        sum.add(square / (of * of), degrees);
    };
    add_scalar(all.turbulent_kinetic_energy, variance.turbulent_kinetic_energy,
               size.turbulent_kinetic_energy);
    add_scalar(all.dissipation_rate, variance.dissipation_rate, size.dissipation_rate);
}

const LoadScale& scale_at(double reynolds_number, const std::vector<double>& reynolds_numbers,
                          const std::vector<LoadScale>& scales) {
    const auto found = std::find(reynolds_numbers.begin(), reynolds_numbers.end(), reynolds_number);
    return scales[static_cast<std::size_t>(found - reynolds_numbers.begin())];
}

}  // namespace

ErrorMetrics LoadScale::at(const LoadEntry& entry) const {
    const auto floored = [](double size, double mean) { return std::hypot(size, 0.5 * mean); };
    return {floored(entry.force.norm(), rms.force), floored(entry.moment.norm(), rms.moment),
            floored(entry.turbulent_kinetic_energy, rms.turbulent_kinetic_energy),
            floored(entry.dissipation_rate, rms.dissipation_rate)};
}

std::optional<RelativeErrors> model_errors(CasePurpose purpose, const Symmetry& symmetry,
                                           const std::vector<SolvedCase>& cases,
                                           const std::vector<double>& reynolds_numbers,
                                           const std::vector<LoadScale>& scales) {
    AllVariances all;
    for (const SolvedCase& table : cases) {
        if (!is_base(table, purpose)) continue;
        const Group group = group_of(table, purpose, cases, direction_tolerance(symmetry));
        if (group.others.empty()) continue;
        add(all, group, variance_of(group, purpose), allowed_components(symmetry, table.sample.direction),
            scale_at(table.reynolds_number, reynolds_numbers, scales));
    }
    if (all.force.empty()) return std::nullopt;
    const double force = all.force.root(purpose);
    return RelativeErrors{force, all.moment.empty() ? force : all.moment.root(purpose),
                          all.turbulent_kinetic_energy.root(purpose), all.dissipation_rate.root(purpose)};
}

}  // namespace samara
