#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace samara {

/// The one exception of the offline tools. Its text is one line for the user: it names the file, the place
/// and the remedy. Programs print it after their name and exit with status 1. The runtime's step never
/// throws.
class Error : public std::runtime_error {
  public:
    /// Makes an error with the message.
    explicit Error(const std::string& message) : std::runtime_error(message) {}
};

/// Calls `work` and returns its result. Puts "LABEL: " before the text of any Error that it throws; the label
/// is most often a file's name.
template <typename Work>
auto labelled(const std::string& label, const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        throw Error(label + ": " + error.what());
    }
}

/// Calls `work` and returns its result. In the text of any Error that it throws, puts `file` in place of
/// `stand_in`, a temporary file that no longer exists when the user reads the message.
template <typename Work>
auto naming(const std::string& file, const std::string& stand_in, const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        std::string what = error.what();
        for (std::size_t at = what.find(stand_in); at != std::string::npos;
             at = what.find(stand_in, at + file.size())) {
            what.replace(at, stand_in.size(), file);
        }
        throw Error(what);
    }
}

}  // namespace samara
