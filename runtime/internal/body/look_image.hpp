#pragma once

#include <cstddef>
#include <string_view>

namespace samara {

/// No image of a look may be larger (bytes).
inline constexpr std::size_t most_image_bytes = 64U << 20U;

/// "png" or "jpg", by the first bytes of an image file that looks take; else nullptr.
inline const char* image_type(std::string_view bytes) {
    if (bytes.size() > most_image_bytes) return nullptr;
    if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return "png";
    return bytes.starts_with("\xff\xd8\xff") ? "jpg" : nullptr;
}

}  // namespace samara
