// The contact sheet of a frontier: a row for each point that is worth a look.
#include "app/frontier/pictures.h"
#include "app/overlay/text.h"
#include "app/overlay/text_block.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::app {
namespace {

constexpr int kSpace = 12, kLineHeight = kGlyphHeight + 6; // pixels
constexpr image::Rgba8 kPaper{255, 255, 255, 255}, kInk{0x11, 0x11, 0x11, 255},
    kFaint{0x66, 0x66, 0x66, 255};

// Each pixel as times x times; opaque.
void put(image::Image& sheet, const image::Image& picture, int left, int top, int times = 1) {
    for (int y = 0; y < picture.height() * times; ++y)
        for (int x = 0; x < picture.width() * times; ++x) {
            image::Rgba8 pixel = picture.at(x / times, y / times);
            pixel.a = 255;
            sheet.at(left + x, top + y) = pixel;
        }
}

} // namespace

image::Image contact_sheet(const FrontierReport& report) {
    struct Row {
        std::vector<std::string> caption;
        PointPictures pictures;
    };
    // Crops are as high as the picture, in whole pixels.
    const image::Image& reference = report.reference;
    const int crop_width = std::min(kCrop, reference.width()),
              crop_height = std::min(kCrop, reference.height());
    const int times = std::max(reference.height() / crop_height, 1);
    const int width = 2 * reference.width() + 2 * crop_width * times + 5 * kSpace;
    const auto letters = static_cast<std::size_t>(std::max(width - 2 * kSpace, 0) / kGlyphWidth);
    const auto fitted = [&](std::string_view text) { return broken_into_lines(text, letters); };
    std::vector<std::string> head = fitted(frontier_head(report));
    for (const std::string& line :
         fitted("Each row: the picture; its error (black is none, each doubling a step lighter); "
                "its worst part, enlarged; the same of the reference."))
        head.push_back(line);
    std::vector<Row> rows;
    int height = kSpace + kLineHeight * static_cast<int>(head.size());
    for (const ShownPoint& shown : shown_points(report)) {
        rows.push_back({fitted(caption_of(report, shown)), pictures_of(report, shown.point)});
        height += kLineHeight * static_cast<int>(rows.back().caption.size()) + reference.height() +
                  2 * kSpace;
    }
    image::Image sheet(width, height);
    draw_panel(sheet, {0, 0, width, height}, kPaper);
    for (image::Rgba8& pixel : sheet.pixels())
        pixel.a = 255;
    int top = kSpace;
    const auto write = [&](const std::vector<std::string>& lines, image::Rgba8 colour) {
        for (const std::string& line : lines) {
            draw_text(sheet, kSpace, top, line, colour);
            top += kLineHeight;
        }
    };
    write(head, kFaint);
    for (const Row& row : rows) {
        top += kSpace;
        write(row.caption, kInk);
        int left = kSpace;
        for (const image::Image* picture : {&row.pictures.drawn, &row.pictures.heat}) {
            put(sheet, *picture, left, top);
            left += picture->width() + kSpace;
        }
        for (const image::Image* crop : {&row.pictures.crop, &row.pictures.right}) {
            put(sheet, *crop, left, top, times);
            left += crop->width() * times + kSpace;
        }
        top += reference.height() + kSpace;
    }
    return sheet;
}

} // namespace scanout::app
