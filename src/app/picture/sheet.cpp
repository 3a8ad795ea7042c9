#include "app/picture/sheet.h"

#include "app/overlay/text.h"
#include "app/overlay/text_block.h"
#include "base/check.h"

namespace scanout::app {
namespace {

constexpr int kMargin = 8, kCaption = kGlyphHeight + 6; // pixels
constexpr image::Rgba8 kSheetPaper{255, 255, 255, 255}, kSheetInk{0x11, 0x11, 0x11, 255};

} // namespace

Size Sheet::size_of(const SheetGrid& grid, int width, int height) {
    return {kMargin + grid.columns * (width + kMargin),
            kMargin + grid.rows * (height + kCaption + kMargin)};
}

Sheet::Sheet(int columns, int rows, int width, int height)
    : grid_{columns, rows}, width_(width), height_(height) {
    const Size size = size_of(grid_, width, height);
    picture_ = image::Image(size.width, size.height, kSheetPaper);
}

void Sheet::add(const image::Image& picture, const std::string& caption) {
    CHECK(next_ < grid_.columns * grid_.rows);
    CHECK(picture.width() == width_ && picture.height() == height_);
    const int left = kMargin + next_ % grid_.columns * (width_ + kMargin);
    const int top = kMargin + next_ / grid_.columns * (height_ + kCaption + kMargin);
    ++next_;
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) {
            image::Rgba8 pixel = picture.at(x, y);
            pixel.a = 255;
            picture_.at(left + x, top + y) = pixel;
        }
    const auto letters = static_cast<std::size_t>(width_ / kGlyphWidth);
    draw_text(picture_, left, top + height_ + 3,
              broken_into_lines(caption, letters > 0 ? letters : 1).front(), kSheetInk);
}

} // namespace scanout::app
