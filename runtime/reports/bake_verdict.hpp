#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "samara/core/body/body.hpp"

namespace samara {

/// Grade of a finding about a bake.
enum class Grade {
    good,     ///< no remedy needed
    limited,  ///< limits a use
    bad,      ///< prevents a use
};

/// Returns "good", "limited" or "bad".
const char* name_of(Grade grade);

/// One finding about a bake.
struct Finding {
    Grade grade;
    std::string what;  ///< a word or two: "force", "meshes"
    std::string text;  ///< one sentence, with its numbers and, unless it is good, the remedy
};

/// The uses that a bake is good for and not, and why.
struct BakeVerdict {
    Grade grade = Grade::good;  ///< good: for metrics; limited: for pictures; bad: not to be used
    std::string headline;       ///< one sentence
    std::vector<std::string> good_for;
    std::vector<std::string> not_for;
    std::vector<Finding> findings;  ///< in the order of the report
};

/// The largest standard error, relative to force, moment or k, with which a bake is called good for metrics
/// that depend on it: 30 % of the force are 15 % of a descent speed.
inline constexpr double good_error = 0.3;

/// Name of the finding about the swings of solved falls.
inline constexpr const char* swings_of_falls = "swings";

/// Judges a body by its file. The body must have tables. `further`: findings about the folder of its cases; a
/// bad one keeps the bake from being good for metrics, one about the swings of its falls from being good for
/// swings.
BakeVerdict judge_bake(const Body& body, const std::vector<Finding>& further = {});

/// Returns a JSON object with headline, grade, good_for, not_for and findings (grade, what, text).
nlohmann::json as_json(const BakeVerdict& verdict);

/// Returns the headline and the uses as lines of text, each ended.
std::string as_text(const BakeVerdict& verdict);

}  // namespace samara
