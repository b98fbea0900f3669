// The program samara-check-tables: compares a body's tables with solved cases that they were not made from.

#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "converter/cases/samples_csv.hpp"
#include "converter/tables/table_check.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

nlohmann::json quantity_as_json(const QuantityCheck& check) {
    return {{"error", check.error}, {"stated", check.stated}, {"within_two", check.within_two}};
}

nlohmann::json check_as_json(const TableCheck& check) {
    nlohmann::json json = {{"force", quantity_as_json(check.force)},
                           {"moment", quantity_as_json(check.moment)},
                           {"turbulent_kinetic_energy", quantity_as_json(check.turbulent_kinetic_energy)},
                           {"dissipation_rate", quantity_as_json(check.dissipation_rate)},
                           {"within_two", check.within_two}};
    for (const CheckedCase& one : check.cases) {
        json["cases"].push_back({{"name", one.name},
                                 {"direction", as_json(one.direction)},
                                 {"reynolds_number", one.reynolds_number},
                                 {"force", as_json(one.value.force)},
                                 {"force_difference", as_json(one.difference.force)},
                                 {"force_error", as_json(one.stated.force)},
                                 {"moment_difference", as_json(one.difference.moment)},
                                 {"moment_error", as_json(one.stated.moment)}});
    }
    return json;
}

void print_row(const char* name, const QuantityCheck& check) {
    print_result("{:<10} {:10.1f} {:10.1f} {:12.0f}\n", name, 100.0 * check.error, 100.0 * check.stated,
                 100.0 * check.within_two);
}

void print_check(const TableCheck& check) {
    print_result("{:<14} {:>26} {:>8} {:>9} {:>9} {:>9}\n", "case", "direction of motion", "Reynolds", "|F|",
                 "off by", "estimate");
    for (const CheckedCase& one : check.cases) {
        print_result("{:<14} ({:7.4f} {:7.4f} {:7.4f}) {:8.0f} {:9.4f} {:9.4f} {:9.4f}\n", one.name,
                     one.direction.x(), one.direction.y(), one.direction.z(), one.reynolds_number,
                     one.value.force.norm(), one.difference.force.norm(), one.stated.force.norm());
    }
    print_result("\n{:<10} {:>10} {:>10} {:>12}\n", "", "error %", "estimate %", "within two %");
    print_row("force", check.force);
    print_row("moment", check.moment);
    print_row("k", check.turbulent_kinetic_energy);
    print_row("epsilon", check.dissipation_rate);
    print_result("{:.0f} % of all differences are within two estimated standard errors\n",
                 100.0 * check.within_two);
}

int run(int argc, const char* const* argv) {
    std::string body_file;
    std::string cases;
    Arguments arguments("samara check-tables", "Compares a body's tables with held-out solved cases");
    arguments.positional("BODY", body_file, "NAME.body.h5 with tables");
    arguments.positional(
        "CASES", cases,
        "a table of cases (.csv), from 'samara bake --probes' or 'samara convert -o NAME.csv'");
    arguments.footer(
        "Error and estimated standard error are root mean squares over the cases: for force and moment\n"
        "relative to the root mean square of the values, for k and epsilon of the logarithms.\n"
        "Example: samara bake ball.geo -o probes.csv --quality high --probes 20\n"
        "         samara check-tables ball.body.h5 probes.csv");
    return run_program(argc, argv, arguments, [&] {
        const Body body = read_body_file(body_file);
        if (!body.tables) {
            throw Error(fmt::format("{}: has no tables; make them with 'samara bake'", body_file));
        }
        const TableCheck check = check_tables(*body.tables, read_samples_csv(cases));
        if (!arguments.json()) print_check(check);
        return check_as_json(check);
    });
}

}  // namespace
}  // namespace samara

int main(int argc, char** argv) {
    return samara::run(argc, argv);
}
