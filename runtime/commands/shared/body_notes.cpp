#include "samara/commands/shared/body_notes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "samara/commands/shared/print.hpp"

namespace samara {
namespace {

constexpr std::size_t most_names = 3;

std::string names_of(const std::vector<std::string>& bodies) {
    const std::size_t named = bodies.size() <= most_names ? bodies.size() : most_names - 1;
    std::string names;
    for (std::size_t i = 0; i < named; ++i) {
        const bool last = i > 0 && i + 1 == bodies.size();
        names += fmt::format("{}'{}'", i == 0 ? "" : last ? " and " : ", ", bodies[i]);
    }
    if (named < bodies.size()) names += fmt::format(" and {} more", bodies.size() - named);
    return names;
}

}  // namespace

BodyNotes::BodyNotes(std::string program) : program_(std::move(program)) {}

void BodyNotes::add(const std::string& type, const std::string& body, double severity,
                    const std::string& text) {
    if (text.empty()) return;
    const auto known = std::ranges::find(notes_, type, &Note::type);
    if (known == notes_.end()) {
        notes_.push_back({type, {body}, body, severity, text});
        return;
    }
    known->bodies.push_back(body);
    known->alike = known->alike && text == known->text;
    if (severity <= known->severity) return;
    known->worst = body;
    known->severity = severity;
    known->text = text;
}

void BodyNotes::print() {
    for (const Note& note : notes_) {
        print_note("{}: warning: {}{}: {}\n", program_, names_of(note.bodies),
                   !note.alike ? fmt::format(" (values of '{}')", note.worst) : "", note.text);
    }
    notes_.clear();
}

std::string shape_warning(const Body& body) {
    constexpr double unsaid = 0.005;
    if (!body.shape_error) return {};
    const ShapeError& error = *body.shape_error;
    if (std::max(std::abs(error.volume), error.distance) <= unsaid) return {};
    std::string text = fmt::format(
        "its mesh has {:.1f} % {} volume than its shape and deviates from it by up to {:.1f} % of its size",
        100.0 * std::abs(error.volume), error.volume < 0.0 ? "less" : "more", 100.0 * error.distance);
    // Rounding facets off adds half to once and a half of what is estimated to lie between.
    const bool rounded = std::abs(error.volume) < 1.5 * error.faceting && body.surface.order() == 2;
    return text + (rounded ? ": it replaces the facets by a smooth surface through their corners; 'samara "
                             "mesh --order 1' keeps the facets"
                           : "; run 'samara mesh' with more --triangles, or without that option");
}

}  // namespace samara
