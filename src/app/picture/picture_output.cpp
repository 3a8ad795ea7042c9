#include "app/picture/picture_output.h"

#include "app/files.h"
#include "app/picture/picture.h"
#include "app/picture/sheet.h"
#include "base/available_memory.h"
#include "base/stopwatch.h"
#include "frame/options.h"
#include "image/animation.h"

#include <optional>
#include <utility>

namespace scanout::app {
namespace {

class FilePerPicture final : public PictureOutput {
public:
    FilePerPicture(const Settings& settings, PictureFormat format)
        : settings_(settings), format_(format) {}

    Result<Written> add(const image::Image& picture, int index, const std::string&) override {
        const Stopwatch watch;
        TRY(const image::Bytes bytes, encode(picture, format_, settings_.pixel_format));
        const double encode_ms = watch.milliseconds();
        const std::string path = numbered(settings_.output, settings_, index);
        TRY_VOID(write_picture(path, bytes));
        return Written{path, bytes.size(), encode_ms};
    }

private:
    const Settings& settings_;
    PictureFormat format_;
};

class Animation final : public PictureOutput {
public:
    explicit Animation(const Settings& settings) : settings_(settings), png_(settings.fps) {}

    Result<Written> add(const image::Image& picture, int, const std::string&) override {
        const Stopwatch watch;
        TRY_VOID(png_.add(picture));
        return Written{"", 0, watch.milliseconds()};
    }
    Result<void> finish() override { return write_picture(settings_.output, png_.file()); }

private:
    const Settings& settings_;
    image::AnimatedPng png_;
};

// To standard output each frame goes at once.
class Video final : public PictureOutput {
public:
    explicit Video(const Settings& settings) : settings_(settings) {}

    Result<Written> add(const image::Image& picture, int, const std::string&) override {
        const Stopwatch watch;
        if (!std::exchange(begun_, true)) {
            const std::string header =
                image::y4m_header(picture.width(), picture.height(), settings_.fps);
            bytes_.assign(header.begin(), header.end());
        }
        const image::Bytes frame = image::y4m_frame(picture);
        bytes_.insert(bytes_.end(), frame.begin(), frame.end());
        const double encode_ms = watch.milliseconds();
        if (settings_.output == "-") {
            TRY_VOID(write_picture("-", bytes_));
            bytes_.clear();
        }
        return Written{"", 0, encode_ms};
    }
    Result<void> finish() override {
        return settings_.output == "-" ? Result<void>() : write_picture(settings_.output, bytes_);
    }

private:
    const Settings& settings_;
    image::Bytes bytes_;
    bool begun_ = false;
};

class SheetOutput final : public PictureOutput {
public:
    SheetOutput(const Settings& settings, PictureFormat format)
        : settings_(settings), format_(format),
          sheet_(settings.sheet->columns, settings.sheet->rows, settings.frame.width,
                 settings.frame.height) {}

    Result<Written> add(const image::Image& picture, int, const std::string& caption) override {
        sheet_.add(picture, caption);
        return Written{};
    }
    Result<void> finish() override {
        TRY(const image::Bytes bytes, encode(sheet_.picture(), format_, settings_.pixel_format));
        return write_picture(settings_.output, bytes);
    }

private:
    const Settings& settings_;
    PictureFormat format_;
    Sheet sheet_;
};

} // namespace

std::unique_ptr<PictureOutput> make_output(const Settings& settings, PictureFormat format) {
    if (settings.sheet) return std::make_unique<SheetOutput>(settings, format);
    if (format == PictureFormat::apng) return std::make_unique<Animation>(settings);
    if (format == PictureFormat::y4m) return std::make_unique<Video>(settings);
    return std::make_unique<FilePerPicture>(settings, format);
}

Result<void> check_output_size(const Settings& s, PictureFormat format, int pictures) {
    if (s.sheet) {
        const int cells = s.sheet->columns * s.sheet->rows;
        if (pictures > cells)
            return fail(Exit::usage, "--sheet {}x{} has {} cells for {} pictures; give it more",
                        s.sheet->columns, s.sheet->rows, cells, pictures);
        const Size size = Sheet::size_of(*s.sheet, s.frame.width, s.frame.height);
        if (size.width > frame::kMaxSide || size.height > frame::kMaxSide ||
            std::int64_t{size.width} * size.height > kMaxPixels)
            return fail(Exit::usage,
                        "--sheet {}x{} of pictures of {}x{} is {}x{}, which is too large; give a "
                        "smaller --size",
                        s.sheet->columns, s.sheet->rows, s.frame.width, s.frame.height, size.width,
                        size.height);
        return {};
    }
    if (format != PictureFormat::y4m || s.output == "-") return {};
    const std::uint64_t bytes = std::uint64_t{3} * static_cast<std::uint64_t>(s.frame.width) *
                                static_cast<std::uint64_t>(s.frame.height) *
                                static_cast<std::uint64_t>(pictures);
    if (bytes > available_bytes() / 2)
        return fail(Exit::usage,
                    "{}: {} MB are too much to hold until the file is whole; stream it: -o - "
                    "--format y4m",
                    s.output, bytes / 1'000'000);
    return {};
}

} // namespace scanout::app
