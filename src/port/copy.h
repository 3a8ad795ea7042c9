// The copy from the back buffer into a display's memory, the same for every display: rows in order,
// each byte written once. The target is never read: memory behind a bus is slow to read, and
// drivers ask for ordered streaming copies (DRM_CAP_DUMB_PREFER_SHADOW, [CONSOLE 2]).
#pragma once

#include "image/image.h"
#include "image/pixel_format.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace scanout::port {

// Encodes the pixels of `damage` (cut to the frame) into `out`, whose rows are `pitch` bytes apart.
void copy_damage(const image::PixelFormat& format, const image::Image& frame,
                 std::span<const image::Rect> damage, std::uint8_t* out, std::size_t pitch);

} // namespace scanout::port
