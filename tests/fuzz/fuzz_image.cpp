// Any bytes as a picture. TGA has no magic number, so the name decides: each input is tried as
// both.
#include "base/check.h"
#include "image/codec.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace scanout;
    const image::DecodeLimits limits{2048, std::int64_t{1} << 18};
    for (const char* name : {"x.png", "x.tga"}) {
        const auto picture = image::decode({data, size}, name, limits);
        if (!picture) {
            CHECK(picture.error().exit == Exit::unreadable &&
                  picture.error().what.starts_with(name));
            continue;
        }
        CHECK(picture->width() > 0 && picture->width() <= limits.max_side);
        CHECK(picture->height() > 0 && picture->height() <= limits.max_side);
        CHECK(std::int64_t{picture->width()} * picture->height() <= limits.max_pixels);
    }
    return 0;
}
