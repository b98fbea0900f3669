#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "converter/falls/fall_identification.hpp"
#include "samara/analysis/metrics/description.hpp"
#include "samara/core/base/numbers.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

nlohmann::json coefficients_as_json(const DynamicCoefficients& coefficients) {
    nlohmann::json json;
    for (const NumberOfMotion& number : numbers_of_motion) json[number.name] = coefficients.*number.member;
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        json[tensor.name] = rows_as_json(coefficients.*tensor.member);
    }
    return json;
}

std::string metrics(const char* source, const Measures& measures) {
    return fmt::format(
        "    {:<9} descends at {:.4g} m/s, {} Hz, inclination up to {:.1f} degrees, {:.3g} rad/s rms, {}\n",
        source, measures.descent_speed, measures.frequency ? fmt::format("{:.3g}", *measures.frequency) : "-",
        degrees * measures.inclination_amplitude, measures.rms_angular_speed, name_of(measures.regime));
}

}  // namespace

nlohmann::json simulated_fall_as_json(const SimulatedFall& fall) {
    return {{"name", fall.name},
            {"solved", as_json(fall.solved)},
            {"flown", as_json(fall.simulated)},
            {"balance", {{"force", fall.balance.force}, {"moment", fall.balance.moment}}}};
}

nlohmann::json identification_as_json(const Identification& identification) {
    nlohmann::json falls = nlohmann::json::array();
    for (const SimulatedFall& fall : identification.falls) falls.push_back(simulated_fall_as_json(fall));
    return {{"prediction_error", identification.prediction_error},
            {"segments", identification.segments},
            {"coefficients", coefficients_as_json(identification.coefficients.values)},
            {"standard_errors", coefficients_as_json(identification.coefficients.standard_errors)},
            {"falls", falls}};
}

std::string simulated_fall_as_text(const SimulatedFall& fall) {
    return fmt::format("  {} (momentum balance: force {:.1f} %, moment {:.1f} %)\n", fall.name,
                       100.0 * fall.balance.force, 100.0 * fall.balance.moment) +
           metrics("full CFD", fall.solved) + metrics("simulated", fall.simulated);
}

std::string identification_as_text(const Identification& identification) {
    std::string text = fmt::format(
        "Dynamic coefficients from {} segments of free fall, with a prediction error of {:.1f} % of the "
        "fall's speed:\n",
        identification.segments, 100.0 * identification.prediction_error);
    for (const SimulatedFall& fall : identification.falls) text += simulated_fall_as_text(fall);
    return text;
}

}  // namespace samara
