// A KMS card in memory. It plays the kernel's part of the seam, can fail at any call, and watches
// the one law that every display must keep: the buffer on the screen is not written.
#pragma once

#include "base/fd.h"
#include "image/pixel_format.h"
#include "platform/drm/device.h"
#include "platform/seat.h"

#include <cerrno>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/eventfd.h>
#include <unistd.h>

namespace scanout::drm {

class TestSeat final : public console::Seat {
public:
    TestSeat() { set_active(true); }
    void set(bool active) { set_active(active); }
    tl::expected<int, int> open_device(const std::string&) override {
        return tl::unexpected<int>(ENOENT);
    }
    void close_device(int) override {}
    int event_fd() const override { return -1; }
    Result<void> dispatch() override { return {}; }
    Result<void> switch_session(int) override { return {}; }
    void set_terminal_keyboard(bool) override {}
    Result<void> text() override { return {}; }
    Result<void> graphics() override { return {}; }
    std::string description() const override { return "test seat"; }
    bool has_console() const override { return true; }
};

inline drmModeModeInfo mode_of(int width, int height, int hz, bool preferred = false) {
    drmModeModeInfo mode{};
    mode.hdisplay = static_cast<std::uint16_t>(width);
    mode.vdisplay = static_cast<std::uint16_t>(height);
    mode.htotal = 1000;
    mode.vtotal = 1000;
    mode.clock = static_cast<std::uint32_t>(hz) * 1000;
    mode.vrefresh = static_cast<std::uint32_t>(hz);
    mode.type = preferred ? DRM_MODE_TYPE_PREFERRED : 0;
    return mode;
}

inline Connector connector_of(std::uint32_t id, const std::string& name, bool connected = true) {
    return {id, name, connected, {mode_of(8, 4, 60, true)}, {40 + id}};
}

struct FakeCard {
    // What it is.
    std::vector<Connector> connectors{connector_of(1, "Virtual-1")};
    bool dumb_buffers = true, only_16_bits = false;
    std::uint32_t padding = 20; // bytes at the end of a row
    // What goes wrong: the call's name -> its error, from call number `after` on.
    std::string failing;
    Errno error = EIO;
    int after = 0;
    std::function<bool(const std::string&)> fails; // or what a whole machine says
    bool hold_events = false;
    std::uint32_t sequence_step = 0; // 0: a driver without a vertical blank

    // What has happened.
    struct Dumb {
        std::vector<std::uint8_t> bytes;
        std::uint32_t pitch = 0;
        int width = 0, height = 0, bytes_per_pixel = 0;
        bool mapped = false;
    };
    std::map<std::uint32_t, Dumb> dumbs;
    std::uint32_t handles = 0;
    std::map<std::uint32_t, std::uint32_t> framebuffers; // id -> handle
    CrtcState crtc{
        .framebuffer = 99, .x = 0, .y = 0, .mode_valid = true, .mode = mode_of(8, 4, 60)};
    std::uint32_t sequence = 0, pending_framebuffer = 0;
    std::uint64_t pending_tag = 0;
    std::vector<FlipEvent> events;
    std::int64_t refresh_time_ns = 0;
    std::vector<std::string> calls;
    std::map<std::string, int> counts;
    int devices = 0;
    Fd readable{::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)};
    std::vector<std::uint8_t> front_snapshot;
    int front_writes = 0; // how often the law was broken

    Errno call(const std::string& name) {
        check_front();
        calls.push_back(name);
        if (fails && fails(name)) return error;
        return name == failing && counts[name]++ >= after ? error : 0;
    }
    bool everything_freed() const { return dumbs.empty() && framebuffers.empty() && devices == 0; }

    Dumb* front() {
        const auto framebuffer = framebuffers.find(crtc.framebuffer);
        return framebuffer == framebuffers.end() ? nullptr : &dumbs.at(framebuffer->second);
    }
    void check_front() {
        if (const Dumb* dumb = front(); dumb != nullptr && dumb->bytes != front_snapshot) {
            ++front_writes;
            front_snapshot = dumb->bytes;
        }
    }
    void show(std::uint32_t framebuffer) {
        crtc.framebuffer = framebuffer;
        if (const Dumb* dumb = front(); dumb != nullptr) front_snapshot = dumb->bytes;
    }
    // The refresh at which a flip happens.
    void refresh() {
        check_front();
        if (pending_framebuffer == 0) return;
        show(std::exchange(pending_framebuffer, 0));
        sequence += sequence_step;
        events.push_back({pending_tag, sequence, refresh_time_ns});
        const std::uint64_t one = 1;
        EXPECT_EQ(::write(readable.get(), &one, sizeof one), 8);
    }
    // The picture on the screen, as the display shows it.
    image::Image screen(const image::PixelFormat& format) {
        Dumb* dumb = front();
        if (dumb == nullptr) return {};
        image::Image picture(dumb->width, dumb->height);
        for (int y = 0; y < dumb->height; ++y)
            image::decode_row(format,
                              dumb->bytes.data() + static_cast<std::size_t>(y) * dumb->pitch,
                              picture.row(y));
        return picture;
    }
    // Bytes beyond the pixels of a row stay as the kernel made them.
    bool padding_untouched() const {
        for (const auto& [handle, dumb] : dumbs)
            for (int y = 0; y < dumb.height; ++y)
                for (std::size_t x = static_cast<std::size_t>(dumb.width) *
                                     static_cast<std::size_t>(dumb.bytes_per_pixel);
                     x < dumb.pitch; ++x)
                    if (dumb.bytes[static_cast<std::size_t>(y) * dumb.pitch + x] != 0) return false;
        return true;
    }
};

class FakeDevice final : public Device {
public:
    explicit FakeDevice(FakeCard& card) : card_(card) { ++card_.devices; }
    FakeDevice(const FakeDevice&) = delete;
    FakeDevice& operator=(const FakeDevice&) = delete;
    ~FakeDevice() override { --card_.devices; }

    std::string driver() override { return "fake"; }
    bool has_dumb_buffers() override {
        return card_.call("has_dumb_buffers") == 0 && card_.dumb_buffers;
    }
    Errno take_master() override { return card_.call("take_master"); }
    Errno connectors(std::vector<Connector>& connectors) override {
        if (const Errno error = card_.call("connectors"); error != 0) return error;
        connectors = card_.connectors;
        return 0;
    }
    Errno crtc(std::uint32_t, CrtcState& state) override {
        if (const Errno error = card_.call("crtc"); error != 0) return error;
        state = card_.crtc;
        return 0;
    }
    Errno set_crtc(std::uint32_t, std::uint32_t, const CrtcState& state) override {
        if (const Errno error = card_.call("set_crtc"); error != 0) return error;
        card_.pending_framebuffer = 0;
        card_.crtc = state;
        card_.show(state.framebuffer);
        return 0;
    }
    Errno create_dumb(int width, int height, int bits, DumbBuffer& buffer) override {
        if (const Errno error = card_.call("create_dumb"); error != 0) return error;
        if (card_.only_16_bits && bits != 16) return EINVAL;
        const std::uint32_t handle = ++card_.handles;
        const std::uint32_t pitch = static_cast<std::uint32_t>(width * bits / 8) + card_.padding;
        buffer = {handle, pitch, std::uint64_t{pitch} * static_cast<std::uint64_t>(height)};
        card_.dumbs[handle] = {std::vector<std::uint8_t>(buffer.size), pitch, width, height,
                               bits / 8};
        return 0;
    }
    void destroy_dumb(std::uint32_t handle) override { EXPECT_EQ(card_.dumbs.erase(handle), 1U); }
    Errno map(const DumbBuffer& buffer, std::uint8_t*& memory) override {
        if (const Errno error = card_.call("map"); error != 0) return error;
        card_.dumbs.at(buffer.handle).mapped = true;
        memory = card_.dumbs.at(buffer.handle).bytes.data();
        return 0;
    }
    void unmap(std::uint8_t* memory, const DumbBuffer& buffer) override {
        EXPECT_EQ(memory, card_.dumbs.at(buffer.handle).bytes.data());
        card_.dumbs.at(buffer.handle).mapped = false;
    }
    Errno add_framebuffer(int, int, int, int, const DumbBuffer& buffer,
                          std::uint32_t& framebuffer) override {
        if (const Errno error = card_.call("add_framebuffer"); error != 0) return error;
        framebuffer = 100 + buffer.handle;
        card_.framebuffers[framebuffer] = buffer.handle;
        return 0;
    }
    void remove_framebuffer(std::uint32_t framebuffer) override {
        card_.check_front();
        EXPECT_EQ(card_.framebuffers.erase(framebuffer), 1U);
    }
    Errno flip(std::uint32_t, std::uint32_t framebuffer, std::uint64_t tag) override {
        if (const Errno error = card_.call("flip"); error != 0) return error;
        if (card_.pending_framebuffer != 0) return EBUSY;
        card_.pending_framebuffer = framebuffer;
        card_.pending_tag = tag;
        if (!card_.hold_events) card_.refresh();
        return 0;
    }
    Errno dirty(std::uint32_t, std::span<const image::Rect>) override {
        return card_.call("dirty");
    }
    int event_fd() const override { return card_.readable.get(); }
    Errno read_events(std::vector<FlipEvent>& events) override {
        if (const Errno error = card_.call("read_events"); error != 0) return error;
        std::uint64_t count = 0;
        [[maybe_unused]] const ssize_t drained = ::read(card_.readable.get(), &count, sizeof count);
        events.insert(events.end(), card_.events.begin(), card_.events.end());
        card_.events.clear();
        return 0;
    }

private:
    FakeCard& card_;
};

} // namespace scanout::drm
