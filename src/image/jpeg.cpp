// JPEG by libjpeg-turbo, baseline and progressive, grey, YCbCr, RGB and CMYK. Its slow integer DCT
// and its upsampling give the same bits with every SIMD target. Errors leave by longjmp, which must
// not pass a destructor: everything that owns something lives outside guarded().
#include "image/decoders.h"

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <cstring>

#include <jerror.h>
#include <jpeglib.h>

namespace scanout::image {

namespace {

// A progressive file has about ten scans; a hostile one has thousands, each of which costs a pass
// over the picture.
constexpr int kMaxScans = 100;
// The memory limit of libjpeg: coefficients of a progressive picture take 6 bytes a pixel, and
// some.
constexpr std::int64_t kWorkBytesPerPixel = 8;
constexpr std::int64_t kWorkBytes = std::int64_t{16} << 20;

struct JpegReader {
    JpegReader();
    JpegReader(const JpegReader&) = delete;
    JpegReader& operator=(const JpegReader&) = delete;
    ~JpegReader() { jpeg_destroy_decompress(&info); }

    jpeg_decompress_struct info{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf exit{};
    char reason[JMSG_LENGTH_MAX] = "";
};

[[noreturn]] void leave(j_common_ptr info) {
    auto* reader = static_cast<JpegReader*>(info->client_data);
    info->err->format_message(info, reader->reason);
    std::longjmp(reader->exit, 1);
}

// libjpeg goes on with grey where the data ends; we say that the file is cut. Other damage that it
// can step over (level -1) stays, as far as it can be shown.
void on_message(j_common_ptr info, int level) {
    if (level < 0 && info->err->msg_code == JWRN_JPEG_EOF) leave(info);
}

void on_progress(j_common_ptr info) {
    auto* reader = static_cast<JpegReader*>(info->client_data);
    if (reader->info.input_scan_number <= kMaxScans) return;
    std::snprintf(reader->reason, sizeof reader->reason, "more than %d scans", kMaxScans);
    std::longjmp(reader->exit, 1);
}

JpegReader::JpegReader() {
    info.err = jpeg_std_error(&errors);
    errors.error_exit = leave;
    errors.emit_message = on_message;
    errors.output_message = [](j_common_ptr) {};
    info.client_data = this;
}

template <class Step>
bool guarded(JpegReader& reader, const Step& step) {
    if (setjmp(reader.exit) != 0) return false;
    step();
    return true;
}

void read_header(JpegReader& reader, std::span<const std::uint8_t> file) {
    jpeg_create_decompress(&reader.info);
    reader.progress.progress_monitor = on_progress;
    reader.info.progress = &reader.progress;
    jpeg_mem_src(&reader.info, file.data(), file.size());
    jpeg_read_header(&reader.info, TRUE);
}

// Four inks, each stored as 255 - ink by Adobe's writers: the paper shows ink * black.
void cmyk_to_rgba(std::span<Rgba8> row, bool inverted) {
    for (Rgba8& p : row) {
        const auto light = [&](std::uint8_t ink) { return inverted ? ink : 255 - ink; };
        const int black = light(p.a);
        const auto mix = [&](std::uint8_t ink) {
            return static_cast<std::uint8_t>((light(ink) * black + 127) / 255);
        };
        p = {mix(p.r), mix(p.g), mix(p.b), 255};
    }
}

void read_pixels(JpegReader& reader, Image& image) {
    jpeg_decompress_struct& info = reader.info;
    const bool cmyk = info.jpeg_color_space == JCS_CMYK || info.jpeg_color_space == JCS_YCCK;
    info.out_color_space = cmyk ? JCS_CMYK : JCS_EXT_RGBA;
    info.dct_method = JDCT_ISLOW;
    info.mem->max_memory_to_use = static_cast<long>(
        static_cast<std::int64_t>(image.pixels().size()) * kWorkBytesPerPixel + kWorkBytes);
    jpeg_start_decompress(&info);
    while (info.output_scanline < info.output_height) {
        const auto row = image.row(static_cast<int>(info.output_scanline));
        auto* out = reinterpret_cast<JSAMPROW>(row.data());
        jpeg_read_scanlines(&info, &out, 1);
        if (cmyk) cmyk_to_rgba(row, info.saw_Adobe_marker != FALSE);
    }
    jpeg_finish_decompress(&info);
}

} // namespace

Result<Image> decode_jpeg(const Source& file) {
    JpegReader reader;
    const auto refused = [&] {
        return fail(Exit::unreadable, "{}: not a readable JPEG: {}", file.name, reader.reason);
    };
    if (!guarded(reader, [&] { read_header(reader, file.bytes); })) return refused();
    TRY_VOID(check_size(file, reader.info.image_width, reader.info.image_height));
    Image image(static_cast<int>(reader.info.image_width),
                static_cast<int>(reader.info.image_height));
    if (!guarded(reader, [&] { read_pixels(reader, image); })) return refused();
    return image;
}

} // namespace scanout::image
