#include "platform/tty/kitty.h"

#include "base/base64.h"
#include "base/check.h"
#include "platform/tty/answers.h"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>

namespace scanout::tty {
namespace {

constexpr std::size_t kMostInAChunk = 4096; // bytes of base64 in one sequence

// Combining marks that number the rows and columns of placeholders: kitty's table, which are the
// marks above (class 230) of Unicode 6.0 that nothing decomposes into.
constexpr std::array<std::uint16_t, kMostPlaceholders> kMarks = {
    0x0305, 0x030d, 0x030e, 0x0310, 0x0312, 0x033d, 0x033e, 0x033f, 0x0346, 0x034a, 0x034b, 0x034c,
    0x0350, 0x0351, 0x0352, 0x0357, 0x035b, 0x0363, 0x0364, 0x0365, 0x0366, 0x0367, 0x0368, 0x0369,
    0x036a, 0x036b, 0x036c, 0x036d, 0x036e, 0x036f, 0x0483, 0x0484, 0x0485, 0x0486, 0x0487, 0x0592,
    0x0593, 0x0594, 0x0595, 0x0597, 0x0598, 0x0599, 0x059c, 0x059d, 0x059e, 0x059f, 0x05a0, 0x05a1,
    0x05a8, 0x05a9, 0x05ab, 0x05ac, 0x05af, 0x05c4, 0x0610, 0x0611, 0x0612, 0x0613, 0x0614, 0x0615,
    0x0616, 0x0617, 0x0657, 0x0658, 0x0659, 0x065a, 0x065b, 0x065d, 0x065e, 0x06d6, 0x06d7, 0x06d8,
    0x06d9, 0x06da, 0x06db, 0x06dc, 0x06df, 0x06e0, 0x06e1, 0x06e2, 0x06e4, 0x06e7, 0x06e8, 0x06eb,
    0x06ec, 0x0730, 0x0732, 0x0733, 0x0735, 0x0736, 0x073a, 0x073d, 0x073f, 0x0740, 0x0741, 0x0743,
    0x0745, 0x0747, 0x0749, 0x074a, 0x07eb, 0x07ec, 0x07ed, 0x07ee, 0x07ef, 0x07f0, 0x07f1, 0x07f3,
    0x0816, 0x0817, 0x0818, 0x0819, 0x081b, 0x081c, 0x081d, 0x081e, 0x081f, 0x0820, 0x0821, 0x0822,
    0x0823, 0x0825, 0x0826, 0x0827, 0x0829, 0x082a, 0x082b, 0x082c, 0x082d, 0x0951, 0x0953, 0x0954,
    0x0f82, 0x0f83, 0x0f86, 0x0f87, 0x135d, 0x135e, 0x135f, 0x17dd, 0x193a, 0x1a17, 0x1a75, 0x1a76,
    0x1a77, 0x1a78, 0x1a79, 0x1a7a, 0x1a7b, 0x1a7c, 0x1b6b, 0x1b6d, 0x1b6e, 0x1b6f, 0x1b70, 0x1b71,
    0x1b72, 0x1b73, 0x1cd0, 0x1cd1, 0x1cd2, 0x1cda, 0x1cdb, 0x1ce0, 0x1dc0, 0x1dc1, 0x1dc3, 0x1dc4,
    0x1dc5, 0x1dc6, 0x1dc7, 0x1dc8, 0x1dc9, 0x1dcb, 0x1dcc, 0x1dd1, 0x1dd2, 0x1dd3, 0x1dd4, 0x1dd5,
    0x1dd6, 0x1dd7, 0x1dd8, 0x1dd9, 0x1dda, 0x1ddb, 0x1ddc, 0x1ddd, 0x1dde, 0x1ddf, 0x1de0, 0x1de1,
    0x1de2, 0x1de3, 0x1de4, 0x1de5, 0x1de6, 0x1dfe, 0x20d0, 0x20d1, 0x20d4, 0x20d5, 0x20d6, 0x20d7,
    0x20db, 0x20dc, 0x20e1, 0x20e7, 0x20e9, 0x20f0, 0x2cef, 0x2cf0, 0x2cf1, 0x2de0, 0x2de1, 0x2de2,
    0x2de3, 0x2de4, 0x2de5, 0x2de6, 0x2de7, 0x2de8, 0x2de9, 0x2dea, 0x2deb, 0x2dec, 0x2ded, 0x2dee,
    0x2def, 0x2df0, 0x2df1, 0x2df2, 0x2df3, 0x2df4, 0x2df5, 0x2df6, 0x2df7, 0x2df8, 0x2df9, 0x2dfa,
    0x2dfb, 0x2dfc, 0x2dfd};

std::string utf8(char16_t code) {
    if (code < 0x800)
        return {static_cast<char>(0xc0 | code >> 6), static_cast<char>(0x80 | (code & 0x3f))};
    return {static_cast<char>(0xe0 | code >> 12), static_cast<char>(0x80 | (code >> 6 & 0x3f)),
            static_cast<char>(0x80 | (code & 0x3f))};
}

std::string packed_rgb(const image::Image& image) {
    std::vector<std::uint8_t> rgb(image.pixels().size() * 3);
    std::uint8_t* out = rgb.data();
    for (const image::Rgba8 p : image.pixels()) {
        *out++ = p.r;
        *out++ = p.g;
        *out++ = p.b;
    }
    uLongf length = ::compressBound(rgb.size());
    std::string packed(length, '\0');
    CHECK_EQ(::compress2(reinterpret_cast<Bytef*>(packed.data()), &length, rgb.data(), rgb.size(),
                         Z_BEST_SPEED),
             Z_OK);
    packed.resize(length);
    return packed;
}

// Control data and payload in as many sequences as it takes.
std::string sent(const image::Image& image, const std::string& keys, bool tmux) {
    const std::string payload = base64(packed_rgb(image));
    std::string out;
    out.reserve(payload.size() * 2);
    for (std::size_t at = 0; at < payload.size(); at += kMostInAChunk) {
        const bool more = at + kMostInAChunk < payload.size();
        const std::string chunk = fmt::format(
            "\x1b_G{}m={};{}\x1b\\",
            at > 0 ? ""
                   : fmt::format("a=T,f=24,o=z,s={},v={},{},", image.width(), image.height(), keys),
            more ? 1 : 0, std::string_view(payload).substr(at, kMostInAChunk));
        out += tmux ? through_tmux(chunk) : chunk;
    }
    return out;
}

} // namespace

std::string kitty_picture(const image::Image& image, unsigned id, int columns, int rows) {
    const std::string cells = columns > 0 ? fmt::format(",c={},r={}", columns, rows) : "";
    return sent(image, fmt::format("i={},p=1,C=1{}", id, cells), false);
}

std::string kitty_placeholders(const image::Image& image, unsigned id, int columns, int rows) {
    rows = std::min(rows, kMostPlaceholders);
    std::string out = sent(image, fmt::format("i={},U=1,c={},r={},q=2", id, columns, rows), true);
    // The id is the text's colour.
    out += fmt::format("\x1b[38;2;{};{};{}m", id >> 16 & 255, id >> 8 & 255, id & 255);
    for (int row = 0; row < rows; ++row) {
        out += fmt::format("\x1b[{};1H", row + 1);
        // The first one says the row; each following one is the next column of the same row.
        out += "\U0010EEEE" + utf8(kMarks[static_cast<std::size_t>(row)]) + utf8(kMarks[0]);
        for (int column = 1; column < columns; ++column)
            out += "\U0010EEEE";
    }
    return out + "\x1b[39m";
}

std::string kitty_delete(unsigned id) {
    return fmt::format("\x1b_Ga=d,d=I,i={},q=2\x1b\\", id);
}

} // namespace scanout::tty
