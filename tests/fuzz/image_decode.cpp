// Any bytes, as a file that is told apart by content and as a TGA: a picture or one line, nothing
// else. Good seeds: tests/image/data.
#include "image/codec.h"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const scanout::image::DecodeLimits limits{.max_side = 2000, .max_pixels = 100000};
    for (const char* name : {"fuzz", "fuzz.tga"}) {
        const auto picture = scanout::image::decode({data, size}, name, limits);
        if (picture && (picture->empty() || picture->width() > limits.max_side)) std::abort();
        if (!picture && picture.error().what.find('\n') != std::string::npos) std::abort();
    }
    return 0;
}
