#include "samara/core/base/base64.hpp"

#include <cstdint>

namespace samara {

std::string base64(std::string_view bytes) {
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const auto byte = [&](std::size_t i) {
        return i < bytes.size() ? std::uint32_t{static_cast<unsigned char>(bytes[i])} : 0U;
    };
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = bytes.size() - i;
        const std::uint32_t three = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
        text += letters[three >> 18U];
        text += letters[three >> 12U & 63U];
        text += left > 1 ? letters[three >> 6U & 63U] : '=';
        text += left > 2 ? letters[three & 63U] : '=';
    }
    return text;
}

}  // namespace samara
