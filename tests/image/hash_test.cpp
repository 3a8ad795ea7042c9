#include "image/hash.h"
#include "pictures.h"

#include <bit>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::image {
namespace {

using namespace test;

// XXH64 written from its specification (github.com/Cyan4973/xxHash, doc/xxhash_spec.md), seed 0.
class PlainXxh64 {
public:
    static std::uint64_t of(const Bytes& data) {
        std::size_t at = 0;
        std::uint64_t h = kP5;
        if (data.size() >= 32) {
            std::uint64_t lane[4] = {kP1 + kP2, kP2, 0, 0 - kP1};
            for (; at + 32 <= data.size(); at += 32)
                for (std::size_t i = 0; i < 4; ++i)
                    lane[i] = round(lane[i], read(data, at + 8 * i, 8));
            h = std::rotl(lane[0], 1) + std::rotl(lane[1], 7) + std::rotl(lane[2], 12) +
                std::rotl(lane[3], 18);
            for (const std::uint64_t l : lane)
                h = (h ^ round(0, l)) * kP1 + kP4;
        }
        h += data.size();
        for (; at + 8 <= data.size(); at += 8)
            h = std::rotl(h ^ round(0, read(data, at, 8)), 27) * kP1 + kP4;
        if (at + 4 <= data.size()) {
            h = std::rotl(h ^ read(data, at, 4) * kP1, 23) * kP2 + kP3;
            at += 4;
        }
        for (; at < data.size(); ++at)
            h = std::rotl(h ^ data[at] * kP5, 11) * kP1;
        h = (h ^ h >> 33) * kP2;
        h = (h ^ h >> 29) * kP3;
        return h ^ h >> 32;
    }

private:
    static constexpr std::uint64_t kP1 = 0x9E3779B185EBCA87u, kP2 = 0xC2B2AE3D27D4EB4Fu,
                                   kP3 = 0x165667B19E3779F9u, kP4 = 0x85EBCA77C2B2AE63u,
                                   kP5 = 0x27D4EB2F165667C5u;
    static std::uint64_t round(std::uint64_t lane, std::uint64_t input) {
        return std::rotl(lane + input * kP2, 31) * kP1;
    }
    static std::uint64_t read(const Bytes& data, std::size_t at, std::size_t count) {
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < count; ++i)
            value |= std::uint64_t{data[at + i]} << (8 * i);
        return value;
    }
};

TEST(Hash, TheOracleKnowsThePublishedAnswers) {
    EXPECT_EQ(PlainXxh64::of({}), 0xEF46DB3751D8E999u);
    EXPECT_EQ(PlainXxh64::of({'a', 'b', 'c'}), 0x44BC2CF5AD770999u);
}

RC_GTEST_PROP(Hash, IsXxh64OfSizeAndRows, ()) {
    const Image picture = any_picture(false);
    Maker bytes;
    bytes.u32(static_cast<std::uint32_t>(picture.width()))
        .u32(static_cast<std::uint32_t>(picture.height()));
    for (int y = 0; y < picture.height(); ++y)
        for (const Rgba8& p : picture.row(y))
            bytes.u8({p.r, p.g, p.b, p.a});
    RC_ASSERT(frame_hash(picture) == PlainXxh64::of(bytes.bytes));
}

RC_GTEST_PROP(Hash, ChangesWithAnyChannelOfAnyPixel, ()) {
    Image picture = any_picture(false);
    const std::uint64_t before = frame_hash(picture);
    Rgba8& pixel =
        picture.at(*rc::gen::inRange(0, picture.width()), *rc::gen::inRange(0, picture.height()));
    std::uint8_t* channels[] = {&pixel.r, &pixel.g, &pixel.b, &pixel.a};
    *channels[*rc::gen::inRange(0, 4)] ^= static_cast<std::uint8_t>(*rc::gen::inRange(1, 256));
    RC_ASSERT(frame_hash(picture) != before);
}

TEST(Hash, TellsShapesOfTheSamePixelsApart) {
    const std::set<std::uint64_t> hashes{frame_hash(Image(2, 8)), frame_hash(Image(8, 2)),
                                         frame_hash(Image(4, 4)), frame_hash(Image())};
    EXPECT_EQ(hashes.size(), 4u);
}

TEST(Hash, TextHasSixteenDigits) {
    EXPECT_EQ(hash_text(0), "0000000000000000");
    EXPECT_EQ(hash_text(0x0123456789abcdefu), "0123456789abcdef");
    EXPECT_EQ(hash_text(~std::uint64_t{0}), "ffffffffffffffff");
}

} // namespace
} // namespace scanout::image
