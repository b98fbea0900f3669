#include <cstddef>
#include <cstdint>

#include "harness.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    samara::fuzz::feed({reinterpret_cast<const char*>(bytes), size});
    return 0;
}
