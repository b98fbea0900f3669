#include "samara/kirchhoff/triangle_rules.hpp"

namespace samara {
namespace {

/// The three points with the shares (1 - 2a, a, a).
void add_three(double a, double weight, std::vector<RulePoint>& rule) {
    for (std::size_t k = 0; k < 3; ++k) {
        RulePoint point{{a, a, a}, weight};
        point.corner_shares[k] = 1.0 - 2.0 * a;
        rule.push_back(point);
    }
}

/// The six points with the shares a, b and what is left, in any order.
void add_six(double a, double b, double weight, std::vector<RulePoint>& rule) {
    const double c = 1.0 - a - b;
    for (const auto& shares : {std::array{a, b, c}, {a, c, b}, {b, a, c}, {b, c, a}, {c, a, b}, {c, b, a}}) {
        rule.push_back({shares, weight});
    }
}

}  // namespace

const std::vector<RulePoint>& triangle_rule_3() {
    static const std::vector<RulePoint> points = [] {
        std::vector<RulePoint> rule;
        add_three(1.0 / 6.0, 1.0 / 3.0, rule);
        return rule;
    }();
    return points;
}

const std::vector<RulePoint>& triangle_rule_6() {
    static const std::vector<RulePoint> points = [] {
        std::vector<RulePoint> rule;
        add_three(0.445948490915965, 0.223381589678011, rule);
        add_three(0.091576213509771, 0.109951743655322, rule);
        return rule;
    }();
    return points;
}

const std::vector<RulePoint>& triangle_rule_12() {
    static const std::vector<RulePoint> points = [] {
        std::vector<RulePoint> rule;
        add_three(0.249286745170910, 0.116786275726379, rule);
        add_three(0.063089014491502, 0.050844906370207, rule);
        add_six(0.310352451033784, 0.053145049844817, 0.082851075618374, rule);
        return rule;
    }();
    return points;
}

const std::vector<RulePoint>& triangle_rule_16() {
    static const std::vector<RulePoint> points = [] {
        std::vector<RulePoint> rule;
        rule.push_back({{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, 0.144315607677787});
        add_three(0.459292588292723, 0.095091634267285, rule);
        add_three(0.170569307751760, 0.103217370534718, rule);
        add_three(0.050547228317031, 0.032458497623198, rule);
        add_six(0.263112829634638, 0.008394777409958, 0.027230314174435, rule);
        return rule;
    }();
    return points;
}

}  // namespace samara
