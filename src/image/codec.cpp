#include "image/codec.h"

#include "base/mapping.h"
#include "image/decoders.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace scanout::image {

Result<void> check_size(const Source& file, std::int64_t width, std::int64_t height) {
    if (width <= 0 || height <= 0)
        return fail(Exit::unreadable, "{}: its header says {}x{} pixels: the file is damaged",
                    file.name, width, height);
    const DecodeLimits& limits = file.limits;
    if (width > limits.max_side || height > limits.max_side || width > limits.max_pixels / height)
        return fail(
            Exit::unreadable,
            "{}: {}x{} pixels are over the limit of {} on a side and {} in all: make it smaller",
            file.name, width, height, limits.max_side, limits.max_pixels);
    return {};
}

static bool ends_in_tga(const std::string& name) {
    constexpr std::string_view kEnd = ".tga";
    return name.size() >= kEnd.size() &&
           std::equal(
               kEnd.begin(), kEnd.end(), name.end() - static_cast<std::ptrdiff_t>(kEnd.size()),
               [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

Result<Image> decode(std::span<const std::uint8_t> file, const std::string& name,
                     const DecodeLimits& limits) {
    const Source source{file, name, limits};
    const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
    if (text.empty()) return fail(Exit::unreadable, "{}: the file is empty", name);
    if (text.starts_with("\x89PNG")) return decode_png(source);
    if (text.starts_with("\xff\xd8\xff")) return decode_jpeg(source);
    if (text.starts_with("P6") || text.starts_with("P7")) return decode_netpbm(source);
    if (ends_in_tga(name)) return decode_tga(source);
    if (text.starts_with("BM")) return decode_bmp(source);
    return fail(Exit::unreadable,
                "{}: is not a picture that scanout reads (PNG, JPEG, BMP, TGA, PPM, PAM)", name);
}

Result<Image> load(const std::string& path, const DecodeLimits& limits) {
    TRY(const Mapping file, Mapping::open(path));
    const std::string_view text = file.text();
    return decode({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, path, limits);
}

} // namespace scanout::image
