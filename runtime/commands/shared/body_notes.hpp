#pragma once

#include <string>
#include <vector>

#include "samara/core/body/body.hpp"

namespace samara {

/// Notes about the bodies of a scene, on standard error: those of one kind come once, in one line.
class BodyNotes {
  public:
    /// `program`: the name before each line, as "samara simulate".
    explicit BodyNotes(std::string program);

    /// Notes a body's text, unless it is empty. Of the notes of a kind, the one of the highest severity is
    /// told, with the names of all its bodies.
    void add(const std::string& kind, const std::string& body, double severity, const std::string& text);
    /// "PROGRAM: note: 'a', 'b' and 3 more (figures of 'b'): TEXT" for each kind, without the brackets where
    /// all said the same, in the order in which they came up; then forgets them.
    void print();

  private:
    struct Note {
        std::string kind;
        std::vector<std::string> bodies;
        std::string worst;
        double severity;
        std::string text;
        bool alike = true;  ///< whether all said the same
    };

    std::string program_;
    std::vector<Note> notes_;
};

/// What a mesh that is not quite its shape differs by, such as "its mesh has 1.6 % more volume than the
/// facets of its file, as the smooth shape through their corners has; ..."; empty below 0.5 % of volume and
/// size.
std::string shape_warning(const Body& body);

}  // namespace samara
