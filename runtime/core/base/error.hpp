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
    /// An error of that text.
    explicit Error(const std::string& message) : std::runtime_error(message) {}
};

/// What the work returns. Its Errors get "LABEL: " before them: what it is done on, most often a file.
template <typename Work>
auto labelled(const std::string& label, const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        throw Error(label + ": " + error.what());
    }
}

/// What the work returns. Where its Errors name `stand_in`, a file that was made on the way and is gone when
/// they are read, they name `file`.
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
