#pragma once

#include <string>

#include <gmock/gmock.h>

#include "samara/core/base/error.hpp"

namespace samara::test {

/// Returns the text of the Error that `call` throws; empty, with a failed test, where it throws none.
template <typename Call>
std::string error_of(const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    ADD_FAILURE() << "no Error was thrown";
    return {};
}

}  // namespace samara::test
