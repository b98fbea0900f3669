#include "converter/tables/table_check.hpp"

#include <cmath>

#include "samara/core/base/error.hpp"

namespace samara {
namespace {

/// Accumulates squared differences and stated errors of one quantity.
class Sum {
  public:
    void add(double difference, double stated, double scale) {
        differences_ += difference * difference;
        stated_ += stated * stated;
        scales_ += scale * scale;
    }
    void count_component(double difference, double stated) {
        components_ += 1.0;
        if (std::abs(difference) <= 2.0 * stated) within_ += 1.0;
    }
    [[nodiscard]] QuantityCheck result() const {
        const double scale = scales_ > 0.0 ? scales_ : 1.0;
        return {std::sqrt(differences_ / scale), std::sqrt(stated_ / scale),
                components_ > 0.0 ? within_ / components_ : 1.0};
    }
    [[nodiscard]] double within() const { return within_; }
    [[nodiscard]] double components() const { return components_; }

  private:
    double differences_ = 0.0;
    double stated_ = 0.0;
    double scales_ = 0.0;
    double within_ = 0.0;
    double components_ = 0.0;
};

void add_load(Sum& sum, const Vector3d& difference, const Vector3d& stated, const Vector3d& value) {
    sum.add(difference.norm(), stated.norm(), value.norm());
    for (int i = 0; i < 3; ++i) sum.count_component(difference[i], stated[i]);
}

void add_positive(Sum& sum, double difference, double stated, double value) {
    if (!(value > 0.0) || !(value + difference > 0.0)) return;
    const double table = value + difference;
    sum.add(std::log(table / value), std::log1p(stated / table), 1.0);
    sum.count_component(difference, stated);
}

}  // namespace

TableCheck check_tables(const LoadTables& tables, const std::vector<SolvedCase>& cases) {
    TableCheck check;
    Sum force;
    Sum moment;
    Sum k;
    Sum epsilon;
    for (const SolvedCase& solved : cases) {
        if (solved.purpose != CasePurpose::table) continue;
        const LoadEntry& value = solved.sample.entry;
        const LoadEntry entry = look_up(tables, solved.sample.direction, solved.reynolds_number);
        const LoadEntryError stated = look_up_error(tables, solved.sample.direction, solved.reynolds_number);
        const LoadEntry difference = {entry.force - value.force, entry.moment - value.moment,
                                      entry.turbulent_kinetic_energy - value.turbulent_kinetic_energy,
                                      entry.dissipation_rate - value.dissipation_rate};
        add_load(force, difference.force, stated.force, value.force);
        add_load(moment, difference.moment, stated.moment, value.moment);
        add_positive(k, difference.turbulent_kinetic_energy, stated.turbulent_kinetic_energy,
                     value.turbulent_kinetic_energy);
        add_positive(epsilon, difference.dissipation_rate, stated.dissipation_rate, value.dissipation_rate);
        check.cases.push_back(
            {solved.name, solved.sample.direction, solved.reynolds_number, value, difference, stated});
    }
    if (check.cases.empty()) throw Error("no case has the purpose table; give a file with such cases");
    check.force = force.result();
    check.moment = moment.result();
    check.turbulent_kinetic_energy = k.result();
    check.dissipation_rate = epsilon.result();
    double within = 0.0;
    double components = 0.0;
    for (const Sum* sum : {&force, &moment, &k, &epsilon}) {
        within += sum->within();
        components += sum->components();
    }
    check.within_two = within / components;
    return check;
}

}  // namespace samara
