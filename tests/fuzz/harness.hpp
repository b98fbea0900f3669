#pragma once

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <type_traits>

#include "samara/core/base/error.hpp"

/// One harness a kind of file: NAME_fuzz.cpp defines feed(), which libFuzzer calls with what it makes up, and
/// replay_main.cpp with the files of corpus/NAME.
namespace samara::fuzz {

/// Has the reader read the input, and holds what it promises: an Error, or content that the rest of samara
/// can work with. Anything else ends the program.
void feed(std::string_view input);

/// Ends the program, which libFuzzer and ctest take for a fault, where a promise does not hold.
inline void require(bool holds, const char* promise) {
    if (holds) return;
    std::fprintf(stderr, "broken promise: %s\n", promise);
    std::abort();
}

/// What `read` returns (for nothing: true), or nothing where it refuses with an Error, which is one line.
template <typename Read>
auto accepted(const Read& read) {
    using Result = std::invoke_result_t<Read>;
    constexpr bool is_void = std::is_void_v<Result>;
    std::optional<std::conditional_t<is_void, bool, Result>> result;
    try {
        if constexpr (is_void) {
            read();
            result = true;
        } else {
            result = read();
        }
    } catch (const Error& error) {
        const std::string_view line = error.what();
        require(!line.empty(), "an Error says what is wrong");
    }
    return result;
}

}  // namespace samara::fuzz
