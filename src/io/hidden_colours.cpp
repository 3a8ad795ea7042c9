#include "io/hidden_colours.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace scanout::io {
namespace {

using image::Image;
using image::Rgba8;

// A mean of colours that count by their alpha.
struct Mean {
    std::uint32_t red = 0, green = 0, blue = 0, alpha = 0;
    void add(const Rgba8& p) {
        red += std::uint32_t{p.r} * p.a;
        green += std::uint32_t{p.g} * p.a;
        blue += std::uint32_t{p.b} * p.a;
        alpha += p.a;
    }
    Rgba8 colour(std::uint8_t with_alpha) const {
        const auto mean = [&](std::uint32_t sum) {
            return static_cast<std::uint8_t>((sum + alpha / 2) / alpha);
        };
        return {mean(red), mean(green), mean(blue), with_alpha};
    }
};

int wrapped(int i, int size) {
    return i < 0 ? size - 1 : i >= size ? 0 : i;
}

// Alpha 0 becomes 1 where some of the eight texels round about, those of the next repeat included,
// are seen: that marks what is filled.
void grow(Image& filled) {
    const Image before = filled;
    for (int y = 0; y < filled.height(); ++y)
        for (int x = 0; x < filled.width(); ++x) {
            if (before.at(x, y).a != 0) continue;
            Mean mean;
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i)
                    mean.add(
                        before.at(wrapped(x + i, before.width()), wrapped(y + j, before.height())));
            if (mean.alpha > 0) filled.at(x, y) = mean.colour(1);
        }
}

bool has_holes(const Image& picture) {
    const auto pixels = picture.pixels();
    return std::any_of(pixels.begin(), pixels.end(), [](const Rgba8& p) { return p.a == 0; });
}

// Half the size; alpha 0 where none of the four texels is seen.
Image halved(const Image& from) {
    Image half((from.width() + 1) / 2, (from.height() + 1) / 2, {0, 0, 0, 0});
    for (int y = 0; y < half.height(); ++y)
        for (int x = 0; x < half.width(); ++x) {
            Mean mean;
            for (int j = 2 * y; j < std::min(2 * y + 2, from.height()); ++j)
                for (int i = 2 * x; i < std::min(2 * x + 2, from.width()); ++i)
                    mean.add(from.at(i, j));
            if (mean.alpha > 0)
                half.at(x, y) =
                    mean.colour(static_cast<std::uint8_t>(std::max(mean.alpha / 4, 1U)));
        }
    return half;
}

} // namespace

bool fill_hidden_colours(Image& picture) {
    if (!has_holes(picture)) return false;
    // Bilinear filtering reaches one texel far, bicubic two.
    Image filled = picture;
    grow(filled);
    grow(filled);
    std::vector<Image> levels;
    levels.push_back(std::move(filled));
    while (has_holes(levels.back()) && (levels.back().width() > 1 || levels.back().height() > 1))
        levels.push_back(halved(levels.back()));
    for (std::size_t level = levels.size() - 1; level-- > 0;) {
        Image& fine = levels[level];
        for (int y = 0; y < fine.height(); ++y)
            for (int x = 0; x < fine.width(); ++x)
                if (fine.at(x, y).a == 0) fine.at(x, y) = levels[level + 1].at(x / 2, y / 2);
    }
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            if (Rgba8& p = picture.at(x, y); p.a == 0) {
                p = levels[0].at(x, y);
                p.a = 0;
            }
    return true;
}

bool paint_clear_alpha(image::Image& picture) {
    const auto pixels = picture.pixels();
    if (std::any_of(pixels.begin(), pixels.end(), [](const image::Rgba8& p) { return p.a != 0; }))
        return false;
    for (image::Rgba8& p : picture.pixels())
        p.a = 255;
    return true;
}

} // namespace scanout::io
