// A picture as sixels that takes no more than so many bytes.
#pragma once

#include "image/image.h"

#include <string>

namespace scanout::tty {

// As sixel_picture(), with fewer colours where that is too long: and with four still, in squares of
// one colour, as large as it takes.
std::string sixel_within(const image::Image& image, int most_colours, std::size_t bytes);

} // namespace scanout::tty
