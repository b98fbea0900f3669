#include "samara/analysis/comparison/comparison_report.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "samara/analysis/metrics/description.hpp"
#include "samara/core/base/numbers.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

using nlohmann::json;

json as_json(const std::optional<Estimate>& estimate) {
    if (!estimate) return nullptr;
    return {{"value", estimate->value},
            {"error", or_null(estimate->error)},
            {"deviation", or_null(estimate->deviation)}};
}

json as_json(const MetricComparison& metric) {
    json result = {{"motion", as_json(metric.motion)},
                   {"reference", as_json(metric.reference)},
                   {"difference", or_null(metric.difference)},
                   {"difference_error", or_null(metric.difference_error)},
                   {"relative_difference", or_null(metric.relative)},
                   {"standard_errors", or_null(metric.in_errors)},
                   {"reference_uncertainty", metric.reference_uncertainty}};
    if (metric.verdict) {
        result["limit"] = metric.verdict->limit;
        result["agrees"] = metric.verdict->agrees;
        result["certain"] = metric.verdict->certain;
    }
    return result;
}

json as_json(const FallSet& set, const std::string& body, const FallLengths& lengths) {
    json result = as_json(set.regimes);
    result["body"] = body;
    result["falls"] = set.falls;
    result["distinct"] = set.distinct;
    result["duration"] = {lengths.shortest, lengths.longest};
    result["pieces"] = set.pieces;
    return result;
}

std::string regime_text(const FallSet& set) {
    const Regime regime = set.regimes.commonest();
    if (set.distinct == 1) return name_of(regime);
    return fmt::format("{}, {} of {}", name_of(regime), set.regimes.of(regime), set.distinct);
}

std::string row(const std::string& what, const std::string& motion, const std::string& reference,
                const std::string& difference, const std::string& verdict) {
    std::string line =
        fmt::format("{:<28} {:<21} {:<21} {:<17} {}", what, motion, reference, difference, verdict);
    line.erase(line.find_last_not_of(' ') + 1);
    return line + '\n';
}

std::string estimate_text(const std::optional<Estimate>& estimate, double scale) {
    return estimate ? with_error(*estimate, scale) : "-";
}

/// Returns a difference as text: "-4.1 +- 1.2 %", or in the metric's own unit.
std::string difference_text(const MetricComparison& metric, double scale, bool relative) {
    if (!metric.difference) return "";
    if (!relative || !metric.relative) {
        const std::string text = with_error({*metric.difference, metric.difference_error, {}}, scale);
        return *metric.difference > 0.0 ? '+' + text : text;
    }
    std::string text = fmt::format("{:+.1f}", 100.0 * *metric.relative);
    if (metric.difference_error) {
        text +=
            fmt::format(" +- {:.1f}", 100.0 * *metric.difference_error / std::abs(metric.reference->value));
    }
    return text + " %";
}

std::string verdict_text(const MetricComparison& metric, double scale) {
    if (!metric.verdict) {
        return metric.in_errors ? fmt::format("{:.1f} standard errors", *metric.in_errors) : "";
    }
    const char* words = metric.verdict->agrees ? "agrees" : "differs";
    if (!metric.motion || !metric.reference) return words;
    const double magnitude = std::abs(metric.reference->value);
    const double share = metric.verdict->limit / magnitude;
    std::string limits = share < 1.0 ? fmt::format("{:.0f} %", 100.0 * share)
                                     : fmt::format("{:.3g}", scale * metric.verdict->limit);
    if (metric.reference_uncertainty > 0.0) {
        limits += fmt::format(" beyond the reference's own {:.2g} %",
                              100.0 * metric.reference_uncertainty / magnitude);
    }
    return fmt::format("{}{} (limit {})", words, metric.verdict->certain ? "" : "?", limits);
}

std::string metric_row(const std::string& what, const MetricComparison& metric, double scale,
                       bool relative = false) {
    return row(what, estimate_text(metric.motion, scale), estimate_text(metric.reference, scale),
               difference_text(metric, scale, relative), verdict_text(metric, scale));
}

std::string distance_text(const char* title, const DistributionComparison& one) {
    const DistributionDistance& distance = one.distance;
    std::string text = fmt::format("  {} apart by {:.3f}", title, distance.distance);
    if (distance.chance) {
        text += fmt::format("; {} by chance {:.3f}, 95 % of them below {:.3f} (p = {:.3f})",
                            distance.by_falls ? "runs" : "swings", distance.chance->mean,
                            distance.chance->limit, distance.chance->probability);
    }
    if (one.verdict) {
        text += fmt::format(": {}{} (limit {:.3f})", one.verdict->agrees ? "agrees" : "differs",
                            one.verdict->certain ? "" : "?", one.verdict->limit);
    }
    return text + '\n';
}

std::string distribution_text(const Comparison& all) {
    std::string text = "distributions over time; inclination in degrees\n";
    for (std::size_t q = 0; q < quantile_percents.size(); ++q) {
        text += metric_row(fmt::format("  {:.0f} % of the time below", quantile_percents[q]),
                           all.quantiles[q], degrees);
    }
    for (std::size_t i = 0; i < all.distributions.size(); ++i) {
        text += distance_text(distribution_titles[i], all.distributions[i]);
    }
    return text;
}

std::string first_swing_text(const Comparison& all) {
    const FirstSwingComparison& swing = all.first_swing;
    std::string text = "first swing\n";
    text += metric_row("  minimum at (s)", swing.minimum_time, 1.0);
    text += metric_row("  minimum (degrees)", swing.minimum_inclination, degrees);
    text += metric_row("  maximum at (s)", swing.maximum_time, 1.0);
    text += metric_row("  maximum (degrees)", swing.maximum_inclination, degrees);
    if (swing.path_distance) {
        text += fmt::format("  paths apart by {} mm (rms) until {:.3g} s, {:.1f} % of the {:.3g} m fallen\n",
                            with_error(*swing.path_distance, 1000.0), *swing.end,
                            100.0 * swing.path_distance->value / std::abs(*swing.distance_fallen),
                            *swing.distance_fallen);
    }
    return text;
}

json as_json(const DistributionComparison& one) {
    const std::optional<Chance>& chance = one.distance.chance;
    json result = {{"distance", one.distance.distance},
                   {"distance_by_chance", chance ? json(chance->mean) : json()},
                   {"distance_by_chance_limit", chance ? json(chance->limit) : json()},
                   {"probability", chance ? json(chance->probability) : json()},
                   {"chance_between", one.distance.by_falls ? "falls" : "swings"}};
    if (one.verdict) {
        result["limit"] = one.verdict->limit;
        result["agrees"] = one.verdict->agrees;
        result["certain"] = one.verdict->certain;
    }
    return result;
}

json as_json(const Landings& landings) {
    return {{"time", as_json(std::optional(landings.time))},
            {"scatter", as_json(std::optional(landings.scatter))},
            {"mean", samara::as_json(landings.mean)}};
}

json as_json(const LandingComparison& landing) {
    return {{"depth", landing.depth},
            {"motion", as_json(landing.motion)},
            {"reference", as_json(landing.reference)},
            {"distance", landing.distance},
            {"distance_by_chance", landing.chance.mean},
            {"distance_by_chance_limit", landing.chance.limit},
            {"probability", landing.chance.probability}};
}

std::string landing_text(const LandingComparison& landing) {
    std::string text = fmt::format("landing {:.3g} m below the release\n", landing.depth);
    text += metric_row("  after (s)", compare_metric(landing.motion.time, landing.reference.time), 1.0, true);
    text += metric_row("  scattered by (mm)",
                       compare_metric(landing.motion.scatter, landing.reference.scatter), 1000.0, true);
    return text + fmt::format(
                      "  places apart by {:.3g} mm; falls by chance {:.3g}, 95 % of them below {:.3g} (p = "
                      "{:.3f})\n",
                      1000.0 * landing.distance, 1000.0 * landing.chance.mean, 1000.0 * landing.chance.limit,
                      landing.chance.probability);
}

bool has_warnings(const Comparison& all) {
    const auto is_uncertain = [](const auto& one) { return one.verdict && !one.verdict->certain; };
    return std::ranges::any_of(all.metrics, is_uncertain) ||
           std::ranges::any_of(all.distributions, is_uncertain);
}

}  // namespace

std::string with_error(const Estimate& estimate, double scale) {
    const double value = scale * estimate.value;
    if (!estimate.error) return fmt::format("{:.4g}", value);
    const double error = scale * *estimate.error;
    // Below a millionth of the value an error is rounding.
    if (!(error > 1e-6 * std::abs(value))) return fmt::format("{:.4g} +- 0", value);
    const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 9);
    return fmt::format("{:.{}f} +- {:.{}f}", value, decimals, error, decimals);
}

json as_json(const Comparison& all) {
    json measures;
    for (const CataloguedMetric& entry : metric_catalogue) {
        measures[entry.key] = as_json(all.metrics[entry.metric]);
    }
    json quantiles = json::array();
    for (std::size_t q = 0; q < quantile_percents.size(); ++q) {
        json one = as_json(all.quantiles[q]);
        one["percent"] = quantile_percents[q];
        quantiles.push_back(one);
    }
    const FirstSwingComparison& swing = all.first_swing;
    json distributions;
    for (std::size_t i = 0; i < all.distributions.size(); ++i) {
        distributions[distribution_keys[i]] = as_json(all.distributions[i]);
    }
    distributions["inclination"]["quantiles"] = quantiles;
    json landings = json::array();
    for (const LandingComparison& landing : all.landings) landings.push_back(as_json(landing));
    return {{"window", {all.window.begin, all.window.end}},
            {"motion", as_json(all.motion, all.motion_body, all.motion_lengths)},
            {"reference", as_json(all.reference, all.reference_body, all.reference_lengths)},
            {"measures", measures},
            {"distributions", distributions},
            {"first_swing",
             {{"minimum_time", as_json(swing.minimum_time)},
              {"minimum_inclination", as_json(swing.minimum_inclination)},
              {"maximum_time", as_json(swing.maximum_time)},
              {"maximum_inclination", as_json(swing.maximum_inclination)},
              {"end", or_null(swing.end)},
              {"path_distance", as_json(swing.path_distance)},
              {"way_fallen", or_null(swing.distance_fallen)}}},
            {"landings", landings},
            {"judges_inclination", all.judges_inclination},
            {"regimes_agree", all.regimes_agree},
            {"regime_is_uncertain", all.regime_is_uncertain},
            {"judged_by", all.irregular_because.empty() ? "metrics" : "distributions"},
            {"irregular_because", all.irregular_because.empty() ? json() : json(all.irregular_because)},
            {"agrees_by_metrics", all.agrees_by_metrics},
            {"agrees", all.agrees},
            {"certain", all.certain},
            {"notes", all.notes}};
}

std::string as_text(const Comparison& all) {
    std::string text = row(fmt::format("{:.3g} s to {:.3g} s of fall", all.window.begin, all.window.end),
                           "motion", "reference", "difference", "");
    text += row("regime", regime_text(all.motion), regime_text(all.reference), "",
                !all.judges_inclination   ? ""
                : all.regime_is_uncertain ? "the reference itself is uncertain"
                : all.regimes_agree       ? "agrees"
                                          : "differs");
    for (const CataloguedMetric& entry : metric_catalogue) {
        const MetricComparison& metric = all.metrics[entry.metric];
        if (is_of_autorotation(entry.metric) && !metric.motion && !metric.reference) continue;
        const std::string what = entry.refines_last ? fmt::format("  {}", entry.title)
                                                    : fmt::format("{} ({})", entry.title, entry.unit);
        text += metric_row(what, metric, entry.in_unit, entry.relative);
    }
    text += distribution_text(all) + first_swing_text(all);
    for (const LandingComparison& landing : all.landings) text += landing_text(landing);
    for (const std::string& note : all.notes) text += "warning: " + note + '\n';
    text += all.agrees ? "the motion agrees with the reference" : "the motion differs from the reference";
    if (!all.irregular_because.empty()) {
        text += fmt::format(", judged by descent, drift and distributions, since {}", all.irregular_because);
    }
    if (!all.certain) text += ", but this is uncertain";
    if (has_warnings(all))
        text +=
            " (?: the limit is less than two standard errors away, these are unknown, or the reference's own "
            "uncertainty decides)";
    return text + '\n';
}

}  // namespace samara
