#include "samara/c_interface/guard.hpp"

#include <algorithm>

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

void require(const void* pointer, const char* name) {
    if (pointer == nullptr) throw Fault(SAMARA_INVALID_ARGUMENT, std::string(name) + " is a null pointer");
}

}  // namespace samara
