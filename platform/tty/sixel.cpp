#include "platform/tty/sixel.h"

#include <algorithm>
#include <charconv>
#include <span>

namespace scanout::tty {
namespace {

using image::Rgba8;

constexpr int kChannels = 3;
constexpr std::size_t kBins = 32 * 32 * 32;

struct Bin {
    std::int64_t count = 0;
    std::array<std::int64_t, kChannels> sum{}; // of codes
};

struct Box {
    std::span<std::uint16_t> bins;
    std::int64_t count = 0;
    std::array<std::int64_t, kChannels> sum{};
    int widest = 0;         // the channel with the greatest square error
    std::int64_t error = 0; // its
};

std::size_t bin_of(Rgba8 p) {
    return static_cast<std::size_t>((p.r >> 3) << 10 | (p.g >> 3) << 5 | p.b >> 3);
}

// Codes in 16ths: a bin's mean is finer than a code.
std::int64_t mean(const Bin& bin, int channel) {
    return bin.sum[static_cast<std::size_t>(channel)] * 16 / bin.count;
}

Box box_of(std::span<std::uint16_t> bins, const std::vector<Bin>& all) {
    Box box{bins, 0, {}, 0, 0};
    std::array<std::int64_t, kChannels> squares{}, sums{};
    for (const std::uint16_t index : bins) {
        const Bin& bin = all[index];
        box.count += bin.count;
        for (std::size_t c = 0; c < kChannels; ++c) {
            const std::int64_t at = mean(bin, static_cast<int>(c));
            box.sum[c] += bin.sum[c];
            sums[c] += at * bin.count;
            squares[c] += at * at * bin.count;
        }
    }
    for (std::size_t c = 0; c < kChannels; ++c) {
        const std::int64_t middle = sums[c] / box.count;
        const std::int64_t error = squares[c] - middle * sums[c];
        if (error <= box.error) continue;
        box.error = error;
        box.widest = static_cast<int>(c);
    }
    if (bins.size() == 1) box.error = 0;
    return box;
}

std::vector<Box> boxes_of(std::span<std::uint16_t> bins, const std::vector<Bin>& all, int most) {
    std::vector<Box> boxes{box_of(bins, all)};
    while (boxes.size() < static_cast<std::size_t>(most)) {
        const auto worst =
            std::max_element(boxes.begin(), boxes.end(),
                             [](const Box& a, const Box& b) { return a.error < b.error; });
        if (worst->error == 0) break;
        const int channel = worst->widest;
        const std::int64_t middle =
            worst->sum[static_cast<std::size_t>(channel)] * 16 / worst->count;
        const auto cut =
            std::partition(worst->bins.begin(), worst->bins.end(), [&](std::uint16_t index) {
                return mean(all[index], channel) <= middle;
            });
        const auto below = static_cast<std::size_t>(cut - worst->bins.begin());
        if (below == 0 || below == worst->bins.size()) { // all at their mean
            worst->error = 0;
            continue;
        }
        const std::span<std::uint16_t> whole = worst->bins;
        *worst = box_of(whole.first(below), all);
        boxes.push_back(box_of(whole.subspan(below), all));
    }
    return boxes;
}

std::uint8_t percent(std::int64_t sum, std::int64_t count) {
    return static_cast<std::uint8_t>((sum * 200 + 255 * count) / (510 * count));
}

void add_number(std::string& out, int number) {
    std::array<char, 12> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    out.append(digits.data(), end);
}

// `count` times the sixel with these bits.
void add_run(std::string& out, unsigned bits, int count) {
    const char sixel = static_cast<char>('?' + bits);
    if (count > 3) {
        out += '!';
        add_number(out, count);
        out += sixel;
    } else {
        out.append(static_cast<std::size_t>(count), sixel);
    }
}

// One band: for each colour in it the columns that have it, a bit a row.
class Band {
public:
    Band(int width, std::size_t colours)
        : width_(width), bits_(colours * static_cast<std::size_t>(width)), spans_(colours) {}

    void put(int x, int row, std::uint8_t colour) {
        Span& span = spans_[colour];
        if (span.end == 0) {
            used_.push_back(colour);
            span = {x, x + 1};
        }
        span.begin = std::min(span.begin, x);
        span.end = std::max(span.end, x + 1);
        bits_[at(colour, x)] |= static_cast<std::uint8_t>(1U << row);
    }

    void write(std::string& out) {
        std::sort(used_.begin(), used_.end());
        for (const std::uint8_t colour : used_) {
            if (colour != used_.front()) out += '$'; // back to the band's start
            out += '#';
            add_number(out, colour);
            const Span span = std::exchange(spans_[colour], Span());
            if (span.begin > 0) add_run(out, 0, span.begin);
            std::uint8_t* const bits = bits_.data() + at(colour, 0);
            for (int x = span.begin; x < span.end;) {
                int end = x + 1;
                while (end < span.end && bits[end] == bits[x])
                    ++end;
                add_run(out, bits[x], end - x);
                x = end;
            }
            std::fill(bits + span.begin, bits + span.end, std::uint8_t{0});
        }
        used_.clear();
        out += '-';
    }

private:
    struct Span {
        int begin = 0, end = 0;
    };
    std::size_t at(std::uint8_t colour, int x) const {
        return std::size_t{colour} * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }
    int width_;
    std::vector<std::uint8_t> bits_;
    std::vector<Span> spans_;
    std::vector<std::uint8_t> used_;
};

} // namespace

Palette palette_of(const image::Image& image, int most_colours) {
    std::vector<Bin> all(kBins);
    for (const Rgba8 p : image.pixels()) {
        Bin& bin = all[bin_of(p)];
        ++bin.count;
        bin.sum[0] += p.r;
        bin.sum[1] += p.g;
        bin.sum[2] += p.b;
    }
    std::vector<std::uint16_t> used;
    for (std::size_t i = 0; i < kBins; ++i)
        if (all[i].count > 0) used.push_back(static_cast<std::uint16_t>(i));
    Palette palette;
    palette.of_bin.resize(kBins);
    for (const Box& box : boxes_of(used, all, most_colours)) {
        for (const std::uint16_t index : box.bins)
            palette.of_bin[index] = static_cast<std::uint8_t>(palette.colours.size());
        palette.colours.push_back({percent(box.sum[0], box.count), percent(box.sum[1], box.count),
                                   percent(box.sum[2], box.count)});
    }
    return palette;
}

std::string sixel_picture(const image::Image& image, int most_colours) {
    const Palette palette = palette_of(image, most_colours);
    // 0;1: pixels that are not named stay; then the aspect ratio and the size.
    std::string out = "\x1bP0;1q\"1;1;";
    add_number(out, image.width());
    out += ';';
    add_number(out, image.height());
    for (std::size_t i = 0; i < palette.colours.size(); ++i) {
        out += '#';
        add_number(out, static_cast<int>(i));
        out += ";2";
        for (const std::uint8_t level :
             {palette.colours[i].r, palette.colours[i].g, palette.colours[i].b}) {
            out += ';';
            add_number(out, level);
        }
    }
    Band band(image.width(), palette.colours.size());
    for (int y = 0; y < image.height(); ++y) {
        const std::span<const Rgba8> row = image.row(y);
        for (int x = 0; x < image.width(); ++x)
            band.put(x, y % kRowsOfABand, palette[row[static_cast<std::size_t>(x)]]);
        if (y % kRowsOfABand == kRowsOfABand - 1 || y == image.height() - 1) band.write(out);
    }
    out.back() = '\x1b'; // instead of the last new band, which would scroll
    return out + '\\';
}

} // namespace scanout::tty
