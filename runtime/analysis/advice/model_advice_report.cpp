#include <array>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "samara/analysis/advice/model_advice.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

using nlohmann::json;

constexpr std::array dynamic_words = {"body", "default", "none"};

json as_json(const ModelSet& models) {
    json result = {{"loads", name_of(models.loads)},
                   {"added_mass", models.added_mass},
                   {"dynamic_coefficients", dynamic_words[static_cast<std::size_t>(models.dynamic)]},
                   {"turbulence", name_of(models.turbulence)}};
    if (models.loads == Loads::coefficients) result["drag_coefficient"] = models.drag_coefficient;
    if (models.table_reynolds_number) result["table_reynolds_number"] = *models.table_reynolds_number;
    if (models.turbulence == Turbulence::constant) {
        result["turbulent_kinetic_energy"] = models.turbulent_kinetic_energy;
        result["dissipation_rate"] = models.dissipation_rate;
    }
    return result;
}

json as_json(const MetricEffect& metric) {
    const auto value_of = [](const std::optional<Estimate>& one) {
        return one ? json(one->value) : json(nullptr);
    };
    return {{"reference", value_of(metric.reference)},
            {"value", value_of(metric.value)},
            {"change", value_of(metric.change)},
            {"error", metric.change ? or_null(metric.change->error) : json(nullptr)},
            {"scale", metric.scale},
            {"limit", or_null(metric.limit)},
            {"verdict", metric.limit ? json(name_of(metric.verdict)) : json(nullptr)}};
}

json as_json(const ModelEffect& one) {
    json metrics;
    for (const Metric metric : advised_metrics) {
        metrics[catalogued(metric).key] = as_json(one.effect.metrics[metric]);
    }
    return {{"left_out", one.left_out.empty() ? json(nullptr) : json(one.left_out)},
            {"part", one.part ? json(name_of(*one.part)) : json(nullptr)},
            {"models", as_json(one.models)},
            {"words", one.words},
            {"needs",
             {{"falls", one.cost.falls},
              {"tables", one.cost.tables},
              {"reynolds_numbers", one.cost.reynolds_numbers},
              {"kirchhoff", one.cost.kirchhoff}}},
            {"flies", one.flies},
            {"falls", one.effect.falls},
            {"figures", metrics},
            {"regime", name_of(one.effect.regime)},
            {"regime_share", one.effect.regime_share},
            {"regimes_agree", one.effect.regimes_agree},
            {"verdict", name_of(one.effect.verdict)},
            {"nanoseconds_per_step", one.nanoseconds_per_step}};
}

/// Returns the change in percent of its scale with its error; "?" where not certain, "!" where beyond.
std::string cell(const MetricEffect& metric) {
    const char* mark = metric.verdict == EffectVerdict::within        ? ""
                       : metric.verdict == EffectVerdict::not_certain ? " ?"
                                                                      : " !";
    if (!metric.limit) return "-";
    if (!metric.change || !(metric.scale > 0.0)) return std::string("-") + mark;
    const double percent = 100.0 / metric.scale;
    const std::string error =
        metric.change->error ? fmt::format(" +- {:.1f}", percent * *metric.change->error) : "";
    return fmt::format("{:+.1f}{}{}", percent * metric.change->value, error, mark);
}

std::string row(const std::string& name, const ModelEffect& one) {
    std::string text = fmt::format("  {:<37}", name);
    if (!one.flies) return text + "diverges\n";
    if (one.effect.falls == 0) return text + "not simulated\n";
    for (const Metric metric : advised_metrics)
        text += fmt::format("{:<17}", cell(one.effect.metrics[metric]));
    text += fmt::format("{:<13}",
                        std::string(name_of(one.effect.regime)) + (one.effect.regimes_agree ? "" : " !"));
    return text + fmt::format("{:<12}{:>6}{:>7.0f} ns\n", name_of(one.effect.verdict), one.effect.falls,
                              one.nanoseconds_per_step);
}

std::string heading(double tolerance) {
    std::string text = fmt::format("  {:<37}", "without (changes in %)");
    for (const Metric metric : advised_metrics) {
        const double limit = 100.0 * tolerance * catalogued(metric).allowed.share;
        text += fmt::format("{:<17}", fmt::format("{} ({:g})", catalogued(metric).heading, limit));
    }
    return text + fmt::format("{:<13}{:<12}{:>6}{:>10}\n", "regime", "verdict", "falls", "a step");
}

/// Returns the metrics of the fullest model, in their own units.
std::string fullest_in_words(const ModelEffect& full) {
    std::vector<std::string> words = {name_of(full.effect.regime)};
    for (const Metric which : advised_metrics) {
        const MetricEffect& metric = full.effect.metrics[which];
        if (!metric.limit || !metric.reference) continue;
        const CataloguedMetric& entry = catalogued(which);
        words.push_back(
            fmt::format("{} {:.3g} {}", entry.heading, entry.in_unit * metric.reference->value, entry.unit));
    }
    words.push_back(fmt::format("{:.0f} ns a step", full.nanoseconds_per_step));
    return fmt::format("{}", fmt::join(words, ", "));
}

std::string needs_in_words(const ModelCost& cost, bool one_direction) {
    std::vector<std::string> words;
    if (cost.falls) words.emplace_back("free falls by full CFD");
    if (cost.tables) {
        words.push_back(fmt::format("OpenFOAM cases{}{}", one_direction ? " in one direction" : "",
                                    cost.reynolds_numbers ? " at several Reynolds numbers" : ""));
    }
    if (cost.kirchhoff) words.emplace_back("the Kirchhoff tensor");
    if (words.empty()) return "the shape and the numbers above";
    return fmt::format("{}", fmt::join(words, "; "));
}

std::string text_of(const BodyAdvice& body, double tolerance) {
    std::string text = fmt::format("{}: falls of {:.3g} s at the Reynolds number {:.3g}, tolerance {:g} %\n",
                                   body.name, body.duration, body.flow.reynolds_number, 100.0 * tolerance);
    text += fmt::format("  fullest: {}\n", body.full.words);
    if (body.full.effect.falls > 0) text += fmt::format("  {}\n", fullest_in_words(body.full));
    for (const std::string& note : body.notes) text += fmt::format("  {}\n", note);
    text += heading(tolerance);
    for (const ModelEffect& omission : body.omissions) text += row(omission.left_out, omission);
    text += row("recommended", body.recommended);
    text += fmt::format("  recommended: {}\n", body.recommended.words);
    return text + fmt::format("  needs: {}\n", needs_in_words(body.recommended.cost, body.one_direction));
}

}  // namespace

std::string as_text(const ModelAdvice& advice) {
    std::string text;
    for (const BodyAdvice& body : advice.bodies) text += text_of(body, advice.tolerance);
    return text;
}

json as_json(const ModelAdvice& advice) {
    json bodies = json::array();
    for (const BodyAdvice& body : advice.bodies) {
        json omissions = json::array();
        for (const ModelEffect& omission : body.omissions) omissions.push_back(as_json(omission));
        bodies.push_back({{"name", body.name},
                          {"duration", body.duration},
                          {"reynolds_number", body.flow.reynolds_number},
                          {"turbulent_kinetic_energy", body.flow.turbulent_kinetic_energy},
                          {"dissipation_rate", body.flow.dissipation_rate},
                          {"one_direction", body.one_direction},
                          {"notes", body.notes},
                          {"full", as_json(body.full)},
                          {"omissions", omissions},
                          {"recommended", as_json(body.recommended)}});
    }
    return {{"tolerance", advice.tolerance}, {"bodies", bodies}};
}

}  // namespace samara
