// The content of a state for a body group, and the description that it must fit.

#include <cmath>
#include <iterator>
#include <string>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "samara/core/simulation/body_group.hpp"

namespace samara {
namespace {

/// Appends a member's value so that it can be told from any other.
struct ExactText {
    std::string& text;

    template <typename Value>
    void operator()(const char* /*key*/, const Value& value) const {
        if constexpr (std::is_enum_v<Value>) {
            append(static_cast<int>(value));
        } else if constexpr (std::is_arithmetic_v<Value>) {
            append(value);
        } else if constexpr (requires { value.has_value(); }) {
            append(value.has_value());
            if (value) (*this)("", *value);
        } else {
            for (const double number : value.reshaped()) append(number);
        }
    }
    template <typename Number>
    void append(const Number& number) const {
        fmt::format_to(std::back_inserter(text), " {}", number);
    }
};

template <typename AnyReport, typename Visit>
void visit_report(AnyReport& report, const Visit& visit) {
    visit(report.steps);
    visit(report.implicit_steps);
    visit(report.most_substeps);
    visit(report.steps_at_limit);
    visit(report.highest_reynolds_number);
    visit(report.moving);
    visit(report.below_table);
}
constexpr std::size_t report_bytes = 5 * sizeof(std::uint64_t) + sizeof(int) + sizeof(double);

}  // namespace

std::string BodyGroup::description() const {
    std::string text = fmt::format("{} {} {} {} inertia {} models", name_, release_.count, release_.start,
                                   loaded_.hash, fmt::join(body_->inertia.reshaped(), " "));
    visit_members(physics_, ExactText{text});
    const ExactText append{text};
    for (const std::uint64_t first : first_steps_) append.append(first);
    for (std::size_t i = 0; release_.spreads_size() && i < batch_.size(); ++i) append.append(size_of(i));
    return text + '\n';
}

std::size_t BodyGroup::state_size() const {
    return sizeof(steps_) + report_bytes +
           batch_.size() * (body_state_bytes + pose_bytes + sizeof(double) + sizeof(std::uint8_t));
}

void BodyGroup::write(StateWriter& writer) const {
    writer.write(steps_);
    visit_report(report_, [&](auto number) { writer.write(number); });
    for (std::size_t i = 0; i < batch_.size(); ++i) {
        BodyState state = batch_.own_state(i);
        // Rest under a wrench must be judged anew.
        state.at_rest = state.at_rest && (acting_.empty() || acting_[i].is_zero());
        writer.write(state);
        writer.write(before_[i]);
        writer.write(before_time_[i]);
        writer.write(static_cast<std::uint8_t>(is_removed(i) ? 1 : 0));
    }
}

bool BodyGroup::read(StateReader& reader, double time, bool keep) {
    std::uint64_t steps = 0;
    StepReport report;
    reader.read(steps);
    visit_report(report, [&](auto& number) { reader.read(number); });
    // Other numbers of steps would be caught up with in the next call, which may take for ever.
    bool sound = steps == steps_until(time);
    for (std::size_t i = 0; i < batch_.size(); ++i) {
        BodyState state;
        Pose before;
        double before_time = 0.0;
        std::uint8_t removed = 0;
        reader.read(state);
        reader.read(before);
        reader.read(before_time);
        reader.read(removed);
        sound = sound && is_sound(state) && is_sound(before) && std::isfinite(before_time);
        if (!keep) continue;
        batch_.keep_own_state(i, state);
        before_[i] = before;
        before_time_[i] = before_time;
        if (is_removed(i) != (removed != 0)) set_removed(i, removed != 0);
    }
    if (keep) {
        wrenches_.clear();
        pushed_.clear();
        pushed_time_ = 0.0;
        acting_.clear();
        batch_.set_external({});
        steps_ = steps;
        report_ = report;
    }
    return sound;
}

}  // namespace samara
