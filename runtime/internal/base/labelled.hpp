#pragma once

#include <string>

#include "samara/base/error.hpp"

namespace samara {

/// What the work returns. Its Errors get "LABEL: " before them: what it is done on, most often a file.
template <typename Work>
auto labelled(const std::string& label, const Work& work) {
    try {
        return work();
    } catch (const Error& fault) {
        throw Error(label + ": " + fault.what());
    }
}

}  // namespace samara
