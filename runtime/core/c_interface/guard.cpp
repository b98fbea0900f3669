#include "samara/core/c_interface/guard.hpp"

#include <algorithm>

#include "samara/core/base/text.hpp"

namespace samara {

void copy_text(std::string_view text, char* buffer, std::size_t size) noexcept {
    if (buffer == nullptr || size == 0) return;
    std::size_t length = std::min(text.size(), size - 1);
    const auto continues = [&](std::size_t i) {
        return (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U;
    };
    if (length < text.size()) {
        while (length > 0 && continues(length)) --length;
    }
    std::copy_n(text.data(), length, buffer);
    buffer[length] = '\0';
}

void copy_printable(std::string_view text, char* buffer, std::size_t size) noexcept {
    try {
        copy_text(printable(text), buffer, size);
    } catch (...) {
        copy_text("", buffer, size);
    }
}

void require(const void* pointer, const char* name) {
    if (pointer == nullptr)
        throw StatusError(SAMARA_INVALID_ARGUMENT, std::string(name) + " is a null pointer");
}

std::mutex& hdf5_mutex() {
    static std::mutex mutex;
    return mutex;
}

samara_status status_of(SimulationError::Reason reason) noexcept {
    switch (reason) {
        case SimulationError::Reason::time_passed:
            return SAMARA_TIME_PASSED;
        case SimulationError::Reason::out_of_range:
            return SAMARA_OUT_OF_RANGE;
        case SimulationError::Reason::foreign_state:
            return SAMARA_FOREIGN_STATE;
        default:
            return SAMARA_INVALID_ARGUMENT;
    }
}

}  // namespace samara
