// stb_image, with nothing but its BMP and TGA decoders. The packaged snapshot trusts headers
// (colour maps shorter than their indices, offsets outside the file, files that end early), so it
// never sees a header from outside: bmp.cpp and tga.cpp check every field and write a plain file of
// their own around the pixel data.
#include "image/decoders.h"

#include <cstring>
#include <limits>
#include <memory>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#include <stb_image.h>

namespace scanout::image {

Result<Image> decode_by_stb(const Bytes& checked_file, const std::string& name) {
    if (checked_file.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        return fail(Exit::unreadable, "{}: is larger than 2 GB", name);
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(checked_file.data(), static_cast<int>(checked_file.size()), &width,
                              &height, &channels, 4),
        stbi_image_free);
    if (!pixels) return fail(Exit::unreadable, "{}: {}", name, stbi_failure_reason());
    Image image(width, height);
    std::memcpy(image.pixels().data(), pixels.get(), image.pixels().size_bytes());
    return image;
}

} // namespace scanout::image
