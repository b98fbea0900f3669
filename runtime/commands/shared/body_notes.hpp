#pragma once

#include <string>
#include <vector>

#include "samara/core/body/body.hpp"

namespace samara {

/// Notes about the bodies of a scene, on standard error: those of one type appear once, in one line.
class BodyNotes {
  public:
    /// Collects notes of `program`, the name before each line, as "samara simulate".
    explicit BodyNotes(std::string program);

    /// Adds a body's note, unless its text is empty. Of the notes of one type, that with the highest severity
    /// is printed, with the names of all its bodies.
    void add(const std::string& type, const std::string& body, double severity, const std::string& text);
    /// Prints "PROGRAM: note: 'a', 'b' and 3 more (values of 'b'): TEXT" for each type, without the brackets
    /// where all texts are equal, in the order in which they were added; then forgets them.
    void print();

  private:
    struct Note {
        std::string type;
        std::vector<std::string> bodies;
        std::string worst;
        double severity;
        std::string text;
        bool alike = true;  ///< whether all texts are equal
    };

    std::string program_;
    std::vector<Note> notes_;
};

/// Returns the difference of a mesh from its shape as text, such as "its mesh has 1.6 % more volume than the
/// facets of its file, as the smooth shape through their corners has; ..."; empty below 0.5 % of volume and
/// size.
std::string shape_warning(const Body& body);

}  // namespace samara
