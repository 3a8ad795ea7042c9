// A picture on its way into a file: format, pixel format, name, hash.
#pragma once

#include "app/options/settings.h"
#include "base/result.h"
#include "image/codec.h"
#include "image/image.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace scanout::app {

// In the order of PictureFormat, which begins with by_name.
inline constexpr std::array<std::string_view, 6> kPictureFormats = {"png", "ppm",  "pam",
                                                                    "raw", "apng", "y4m"};

// The format of the name's extension, in any case; nothing for other names.
std::optional<PictureFormat> format_of_name(std::string_view path);

// The format of an output file: the format that the user asked for, or the extension's; "-" is PNG.
// Exit::usage where neither names a format, or where they differ.
Result<PictureFormat> picture_format(const std::string& path, PictureFormat asked);

// Would a display of this format dither although --dither none forbids it? Then it has to be given
// image::without_dither() of the picture.
bool dithers_unasked(const Settings& settings, const image::PixelFormat& format);

// The picture as the display of --pixel-format shows it; unchanged without one.
image::Image displayed(const image::Image& picture, const Settings& settings);

// The file's bytes; of apng and y4m, a file of one picture. raw: the bytes of --pixel-format, or
// RGBA8, rows from the top without padding.
Result<image::Bytes> encode(const image::Image& picture, PictureFormat format,
                            const std::optional<image::PixelFormat>& pixel_format);

// How many pictures a model gets.
int pictures(const Settings& settings);

// `name` with {n} replaced by the picture's number, from 0, and {frame} by that of its frame; each
// padded to as many digits as the last one has.
std::string numbered(const std::string& name, const Settings& settings, int index);
inline bool has_number(const std::string& name) {
    return name.find("{n}") != std::string::npos || name.find("{frame}") != std::string::npos;
}

// `name` with {name} replaced by the model file's name, without folder and extension.
std::string named(const std::string& name, const std::string& model_path);
inline bool has_name(const std::string& name) {
    return name.find("{name}") != std::string::npos;
}

// write_file, and SIGINT, SIGTERM and SIGHUP wait until it is done: no temporary file is left.
Result<void> write_picture(const std::string& path, const image::Bytes& bytes);

} // namespace scanout::app
