#include "fake_card.h"
#include "platform/linux-fb/fb_display.h"

#include <cstring>
#include <functional>

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

namespace scanout::linux_fb {
namespace {

using drm::TestSeat;

// A frame buffer in a memory file. Its memory starts with the byte 0xA5 everywhere, so that every
// byte the display must not touch is seen.
struct FakeFb {
    fb_var_screeninfo variable{};
    fb_fix_screeninfo fixed{};
    Errno variable_error = 0, fixed_error = 0, map_error = 0, colors_error = 0;
    ColorTable colors;
    Fd memory{::memfd_create("fb", MFD_CLOEXEC)};

    FakeFb(int width, int height, const image::PixelFormat& format, std::uint32_t padding = 0) {
        variable.xres = variable.xres_virtual = static_cast<std::uint32_t>(width);
        variable.yres = variable.yres_virtual = static_cast<std::uint32_t>(height);
        variable.bits_per_pixel = static_cast<std::uint32_t>(format.bits_per_pixel);
        const auto field = [](const image::Channel& channel) {
            return fb_bitfield{static_cast<std::uint32_t>(channel.offset),
                               static_cast<std::uint32_t>(channel.bits), 0};
        };
        variable.red = field(format.red);
        variable.green = field(format.green);
        variable.blue = field(format.blue);
        variable.transp = field(format.alpha);
        std::strcpy(fixed.id, "fake");
        fixed.type = FB_TYPE_PACKED_PIXELS;
        fixed.visual = FB_VISUAL_TRUECOLOR;
        fixed.line_length = static_cast<std::uint32_t>(width * format.bytes_per_pixel()) + padding;
        resize(fixed.line_length * static_cast<std::uint32_t>(height));
    }
    void resize(std::uint32_t size) {
        fixed.smem_len = size;
        const std::vector<std::uint8_t> filler(std::size_t{size} + 8192, 0xA5);
        EXPECT_EQ(::pwrite(memory.get(), filler.data(), filler.size(), 0),
                  static_cast<ssize_t>(filler.size()));
    }
    std::vector<std::uint8_t> bytes() const {
        std::vector<std::uint8_t> all(std::size_t{fixed.smem_len} + 8192);
        EXPECT_EQ(::pread(memory.get(), all.data(), all.size(), 0),
                  static_cast<ssize_t>(all.size()));
        return all;
    }
};

class FakeDevice final : public Device {
public:
    explicit FakeDevice(FakeFb& fb) : fb_(fb) {}
    FakeDevice(const FakeDevice&) = delete;
    FakeDevice& operator=(const FakeDevice&) = delete;
    ~FakeDevice() override {
        if (memory_ != nullptr) ::munmap(memory_, size_);
    }
    Errno variable(fb_var_screeninfo& info) override {
        info = fb_.variable;
        return fb_.variable_error;
    }
    Errno fixed(fb_fix_screeninfo& info) override {
        info = fb_.fixed;
        return fb_.fixed_error;
    }
    Errno map(std::size_t size, std::uint8_t*& memory) override {
        if (fb_.map_error != 0) return fb_.map_error;
        size_ = size;
        memory_ = ::mmap(nullptr, size, PROT_WRITE, MAP_SHARED, fb_.memory.get(), 0);
        memory = static_cast<std::uint8_t*>(memory_);
        return 0;
    }
    Errno get_colors(ColorTable& table) override {
        table.red.assign(table.red.size(), 7);
        return fb_.colors_error;
    }
    Errno set_colors(const ColorTable& table) override {
        fb_.colors = table;
        return fb_.colors_error;
    }

private:
    FakeFb& fb_;
    void* memory_ = nullptr;
    std::size_t size_ = 0;
};

Result<std::unique_ptr<FbDisplay>> open(FakeFb& fb, const console::Seat& seat) {
    return FbDisplay::create(std::make_unique<FakeDevice>(fb), "/dev/fb0", seat);
}

image::Image picture(int width, int height, int seed) {
    image::Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y) = {static_cast<std::uint8_t>(x * 37 + seed * 11),
                              static_cast<std::uint8_t>(y * 53 + seed * 7),
                              static_cast<std::uint8_t>((x ^ y) * 29 + seed * 3), 255};
    return image;
}

std::vector<image::PixelFormat> formats() {
    std::vector<image::PixelFormat> all{
        {16, {11, 5}, {5, 6}, {0, 5}, {0, 0}},  {16, {0, 5}, {5, 6}, {11, 5}, {0, 0}},
        {16, {10, 5}, {5, 5}, {0, 5}, {0, 0}},  {16, {10, 5}, {5, 5}, {0, 5}, {15, 1}},
        {16, {8, 4}, {4, 4}, {0, 4}, {12, 4}},  {24, {16, 8}, {8, 8}, {0, 8}, {0, 0}},
        {24, {0, 8}, {8, 8}, {16, 8}, {0, 0}},  {32, {16, 8}, {8, 8}, {0, 8}, {0, 0}},
        {32, {16, 8}, {8, 8}, {0, 8}, {24, 8}}, {32, {0, 8}, {8, 8}, {16, 8}, {24, 8}},
        {32, {24, 8}, {16, 8}, {8, 8}, {0, 0}}, {32, {8, 8}, {16, 8}, {24, 8}, {0, 8}},
    };
    std::erase_if(all, [](const image::PixelFormat& format) { return !image::check(format); });
    return all;
}

TEST(FbDisplay, WritesEveryPixelExactlyAndNoOtherByteInEveryFormatPaddingAndOffset) {
    ASSERT_GE(formats().size(), 10U);
    constexpr int kWidth = 13, kHeight = 5;
    for (const image::PixelFormat& format : formats())
        for (const std::uint32_t padding : {0U, 3U, 64U})
            for (const bool panned : {false, true})
                for (const unsigned lead : {0U, 24U}) {
                    FakeFb fb(kWidth, kHeight, format, padding);
                    if (panned) { // a window into a larger picture
                        fb.variable.xoffset = 2;
                        fb.variable.yoffset = 3;
                        fb.fixed.line_length += 16;
                        fb.resize(fb.fixed.line_length * (kHeight + 3));
                    }
                    fb.fixed.smem_start = 0x10000 + lead;
                    std::vector<std::uint8_t> expected = fb.bytes();
                    const image::Image frame = picture(kWidth, kHeight, 1);
                    const auto bytes = static_cast<std::size_t>(format.bytes_per_pixel());
                    for (int y = 0; y < kHeight; ++y)
                        for (int x = 0; x < kWidth; ++x) {
                            const std::size_t at =
                                lead +
                                (static_cast<std::size_t>(y) + fb.variable.yoffset) *
                                    fb.fixed.line_length +
                                (static_cast<std::size_t>(x) + fb.variable.xoffset) * bytes;
                            // Pixel by pixel; tests/image says what its bytes are.
                            image::encode_row(format, std::span(&frame.at(x, y), 1), x, y,
                                              &expected[at]);
                        }
                    const TestSeat seat;
                    auto display = open(fb, seat);
                    ASSERT_TRUE(display) << display.error().what;
                    ASSERT_TRUE((*display)->present(frame, {}));
                    ASSERT_EQ(fb.bytes(), expected)
                        << image::name_of(format) << padding << panned << lead;
                }
}

TEST(FbDisplay, CopiesDamagedPixelsOnlyAndTheWholeAfterASwitchOfTheConsole) {
    const image::PixelFormat format;
    FakeFb fb(13, 5, format);
    TestSeat seat;
    auto display = open(fb, seat);
    ASSERT_TRUE(display);
    ASSERT_TRUE((*display)->present(picture(13, 5, 1), {}));
    const auto shown = [&] {
        image::Image image(13, 5);
        const auto bytes = fb.bytes();
        for (int y = 0; y < 5; ++y)
            image::decode_row(format,
                              bytes.data() + static_cast<std::size_t>(y) * fb.fixed.line_length,
                              image.row(y));
        return image;
    };
    const image::Rect damage{3, 1, 5, 2};
    ASSERT_TRUE((*display)->present(picture(13, 5, 2), {&damage, 1}));
    image::Image expected = picture(13, 5, 1);
    for (const int x : {3, 4})
        expected.at(x, 1) = picture(13, 5, 2).at(x, 1);
    EXPECT_EQ(shown(), expected);
    seat.set(false);
    EXPECT_TRUE((*display)->lost());
    EXPECT_FALSE((*display)->ready());
    seat.set(true);
    EXPECT_TRUE((*display)->stale());
    ASSERT_TRUE((*display)->present(picture(13, 5, 3), {}));
    EXPECT_FALSE((*display)->stale());
    EXPECT_EQ(shown(), picture(13, 5, 3));
}

TEST(FbDisplay, RefusesWhatItCannotDrawWithOneLineThatNamesTheDevice) {
    const image::PixelFormat format;
    const std::vector<std::pair<std::function<void(FakeFb&)>, std::string>> cases{
        {[](FakeFb& fb) {
             fb.variable.bits_per_pixel = 8;
             fb.fixed.visual = FB_VISUAL_PSEUDOCOLOR;
         },
         "8 bits of palette"},
        {[](FakeFb& fb) {
             fb.variable.bits_per_pixel = 1;
             fb.fixed.visual = FB_VISUAL_MONO01;
         },
         "1 bits of palette"},
        {[](FakeFb& fb) { fb.fixed.type = FB_TYPE_VGA_PLANES; }, "planes"},
        {[](FakeFb& fb) { fb.variable.nonstd = 1; }, "planes"},
        {[](FakeFb& fb) { fb.variable.grayscale = 1; }, "grey"},
        {[](FakeFb& fb) { fb.variable.red.msb_right = 1; }, "mirrored"},
        {[](FakeFb& fb) { fb.variable.bits_per_pixel = 15; }, ""},
        {[](FakeFb& fb) { fb.variable.red.offset = 30; }, ""},
        {[](FakeFb& fb) { fb.variable.xres = 0; }, "0x5"},
        {[](FakeFb& fb) { fb.variable.yres = 4000000000U; }, "4000000000"},
        {[](FakeFb& fb) { fb.fixed.smem_len -= 1; }, "does not hold"},
        {[](FakeFb& fb) { fb.variable.yoffset = 4294967295U; }, "does not hold"},
        {[](FakeFb& fb) { fb.fixed.line_length = 13 * 4 - 1; }, "does not hold"},
        {[](FakeFb& fb) { fb.variable_error = ENOTTY; }, "is no frame buffer: Inappropriate ioctl"},
        {[](FakeFb& fb) { fb.fixed_error = ENODEV; }, "is no frame buffer: No such device"},
        {[](FakeFb& fb) { fb.map_error = EINVAL; }, "cannot be mapped: Invalid argument"},
        {[](FakeFb& fb) {
             fb.fixed.visual = FB_VISUAL_DIRECTCOLOR;
             fb.colors_error = EINVAL;
         },
         "colour table"},
    };
    for (const auto& [spoil, reason] : cases) {
        FakeFb fb(13, 5, format);
        spoil(fb);
        const TestSeat seat;
        const auto display = open(fb, seat);
        ASSERT_FALSE(display) << reason;
        EXPECT_EQ(display.error().exit, Exit::no_display);
        EXPECT_TRUE(display.error().what.starts_with("/dev/fb0: ")) << display.error().what;
        EXPECT_NE(display.error().what.find(reason), std::string::npos) << display.error().what;
        EXPECT_EQ(display.error().what.find('\n'), std::string::npos);
    }
}

TEST(FbDisplay, AColourTableIsStraightWhileWeDrawAndPutBackAfterwards) {
    FakeFb fb(13, 5, {16, {11, 5}, {5, 6}, {0, 5}, {0, 0}});
    fb.fixed.visual = FB_VISUAL_DIRECTCOLOR;
    const TestSeat seat;
    auto display = open(fb, seat);
    ASSERT_TRUE(display);
    ASSERT_EQ(fb.colors.red.size(), 64U);
    EXPECT_EQ(fb.colors.red[0], 0);
    EXPECT_EQ(fb.colors.red[31], 0xffff) << "five bits of red";
    EXPECT_EQ(fb.colors.green[32], 32 * 0xffff / 63) << "six of green";
    EXPECT_EQ(fb.colors.green[63], 0xffff);
    display->reset();
    EXPECT_EQ(fb.colors.red[31], 7);
}

TEST(FbDisplay, KnowsItsRefreshFromThePixelClockAndAssumes60WithoutOne) {
    const image::PixelFormat format;
    FakeFb fb(640, 480, format);
    EXPECT_EQ(layout_of(fb.variable, fb.fixed)->refresh_hz, 60);
    fb.variable.pixclock = 39722; // VGA: 25.175 MHz, 800 x 525
    fb.variable.left_margin = 40;
    fb.variable.right_margin = 24;
    fb.variable.hsync_len = 96;
    fb.variable.upper_margin = 32;
    fb.variable.lower_margin = 11;
    fb.variable.vsync_len = 2;
    EXPECT_NEAR(layout_of(fb.variable, fb.fixed)->refresh_hz, 59.94, 0.01);
}

TEST(OpenDevice, SaysWhatIsWrongWithThePath) {
    const auto missing = open_device("/dev/no-such-fb");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().what, "/dev/no-such-fb: No such file or directory");
    EXPECT_EQ(missing.error().exit, Exit::no_display);
}

} // namespace
} // namespace scanout::linux_fb
