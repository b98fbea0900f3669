#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "samara/core/body/body.hpp"

namespace samara {

/// What a finding says about a bake.
enum class Grade {
    good,     ///< as it should be
    limited,  ///< to be known about
    bad,      ///< keeps the bake from a use
};

/// "good", "limited" or "bad".
const char* name_of(Grade grade);

/// One thing that a bake is judged by.
struct Finding {
    Grade grade;
    std::string what;  ///< a word or two: "force", "meshes"
    std::string text;  ///< one sentence, with its figures and, unless it is good, the remedy
};

/// What a bake is good for and what not, and why.
struct BakeVerdict {
    Grade grade = Grade::good;  ///< good: for figures; limited: for pictures; bad: not to be used
    std::string headline;       ///< one sentence
    std::vector<std::string> good_for;
    std::vector<std::string> not_for;
    std::vector<Finding> findings;  ///< in the order in which they are read
};

/// The largest standard errors, over the quantity, with which a bake is called good for figures of it: of the
/// force 30 %, which are 15 % of a descent speed; of moment and k the same.
inline constexpr double good_error = 0.3;

/// What the finding about the swings of solved falls is called.
inline constexpr const char* swings_of_falls = "swings";

/// Judges a body by what its file holds. The body must have tables. `further`: what else was found out, of
/// the folder of its cases; a bad one keeps the bake from being good for figures, one about the swings of its
/// falls from being good for swings.
BakeVerdict judge_bake(const Body& body, const std::vector<Finding>& further = {});

/// headline, grade, good_for, not_for and findings (grade, what, text).
nlohmann::json as_json(const BakeVerdict& verdict);

/// The same for people: lines, each ended.
std::string as_text(const BakeVerdict& verdict);

}  // namespace samara
