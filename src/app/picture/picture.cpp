#include "app/picture/picture.h"

#include "app/files.h"
#include "base/write_file.h"
#include "image/animation.h"

#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstring>

namespace scanout::app {
namespace {

std::string_view text_of(PictureFormat format) {
    return format == PictureFormat::by_name ? ""
                                            : kPictureFormats[static_cast<std::size_t>(format) - 1];
}

// Blocks the signals that would end the program, during its lifetime.
class SignalsHeldBack {
public:
    SignalsHeldBack() {
        sigset_t held;
        sigemptyset(&held);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP})
            sigaddset(&held, signal);
        ::pthread_sigmask(SIG_BLOCK, &held, &before_);
    }
    ~SignalsHeldBack() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
    SignalsHeldBack(const SignalsHeldBack&) = delete;
    SignalsHeldBack& operator=(const SignalsHeldBack&) = delete;

private:
    sigset_t before_{};
};

image::Bytes raw_bytes(const image::Image& picture,
                       const std::optional<image::PixelFormat>& pixel_format) {
    const auto height = static_cast<std::size_t>(picture.height());
    const auto width = static_cast<std::size_t>(picture.width());
    if (!pixel_format) {
        image::Bytes bytes(width * height * sizeof(image::Rgba8));
        std::memcpy(bytes.data(), picture.pixels().data(), bytes.size());
        return bytes;
    }
    const std::size_t pitch = width * static_cast<std::size_t>(pixel_format->bytes_per_pixel());
    image::Bytes bytes(pitch * height);
    for (int y = 0; y < picture.height(); ++y)
        image::encode_row(*pixel_format, picture.row(y), 0, y,
                          bytes.data() + static_cast<std::size_t>(y) * pitch);
    return bytes;
}

} // namespace

std::optional<PictureFormat> format_of_name(std::string_view path) {
    const std::size_t dot = path.rfind('.');
    std::string extension(dot == std::string_view::npos ? "" : path.substr(dot + 1));
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto* const known = std::find(kPictureFormats.begin(), kPictureFormats.end(), extension);
    if (known == kPictureFormats.end()) return std::nullopt;
    return static_cast<PictureFormat>(known - kPictureFormats.begin() + 1);
}

Result<PictureFormat> picture_format(const std::string& path, PictureFormat asked) {
    const std::optional<PictureFormat> named = format_of_name(path);
    const bool animated =
        named == PictureFormat::png && asked == PictureFormat::apng; // is a PNG, too
    if (named && asked != PictureFormat::by_name && *named != asked && !animated)
        return fail(Exit::usage,
                    "{}: the name says {}, --format says {}; leave --format out, or "
                    "change the name",
                    path, text_of(*named), text_of(asked));
    if (asked != PictureFormat::by_name) return asked;
    if (path == "-") return PictureFormat::png;
    if (named) return *named;
    return fail(Exit::usage,
                "{}: the name does not end in .png, .ppm, .pam, .raw, .apng or .y4m; say --format",
                path);
}

bool dithers_unasked(const Settings& settings, const image::PixelFormat& format) {
    return settings.frame.dither == "none" && image::min_bits(format) < 8;
}

image::Image displayed(const image::Image& picture, const Settings& settings) {
    if (!settings.pixel_format) return picture;
    const image::PixelFormat& format = *settings.pixel_format;
    return image::as_displayed(format, dithers_unasked(settings, format)
                                           ? image::without_dither(format, picture)
                                           : picture);
}

Result<image::Bytes> encode(const image::Image& picture, PictureFormat format,
                            const std::optional<image::PixelFormat>& pixel_format) {
    switch (format) {
    case PictureFormat::ppm:
        return image::encode_ppm(picture);
    case PictureFormat::pam:
        return image::encode_pam(picture);
    case PictureFormat::raw:
        return raw_bytes(picture, pixel_format);
    case PictureFormat::apng: {
        image::AnimatedPng animation(1);
        TRY_VOID(animation.add(picture));
        return animation.file();
    }
    case PictureFormat::y4m: {
        const std::string header = image::y4m_header(picture.width(), picture.height(), 1);
        image::Bytes bytes(header.begin(), header.end());
        const image::Bytes frame = image::y4m_frame(picture);
        bytes.insert(bytes.end(), frame.begin(), frame.end());
        return bytes;
    }
    case PictureFormat::by_name:
    case PictureFormat::png:
        break;
    }
    return image::encode_png(picture);
}

int pictures(const Settings& s) {
    return s.range ? s.range->last - s.range->first + 1 : std::max(s.turntable, 1);
}

static std::string replaced(std::string name, std::string_view mark, const std::string& text) {
    for (std::size_t place = name.find(mark); place != std::string::npos;
         place = name.find(mark, place + text.size()))
        name.replace(place, mark.size(), text);
    return name;
}

std::string numbered(const std::string& name, const Settings& s, int index) {
    const auto padded = [](int number, int last) {
        return fmt::format("{:0{}}", number, fmt::formatted_size("{}", last));
    };
    const int count = pictures(s), first = s.range ? s.range->first : 0;
    return replaced(replaced(name, "{n}", padded(index, count - 1)), "{frame}",
                    padded(first + index, first + count - 1));
}

std::string named(const std::string& name, const std::string& model_path) {
    const std::string file = file_name_of(model_path);
    const std::size_t dot = file.rfind('.');
    return replaced(name, "{name}", dot == 0 ? file : file.substr(0, dot));
}

Result<void> write_picture(const std::string& path, const image::Bytes& bytes) {
    const SignalsHeldBack held;
    return write_file(path, bytes);
}

} // namespace scanout::app
