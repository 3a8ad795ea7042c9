// The seam to a KMS card: every ioctl that a display needs, on plain values. kernel_device.h is the
// kernel's; the tests play one that can fail at each call.
#pragma once

#include "image/image.h"

#include <xf86drmMode.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace scanout::drm {

using Errno = int; // 0: done

struct Connector {
    std::uint32_t id = 0;
    std::string name; // "HDMI-A-1"
    bool connected = false;
    std::vector<drmModeModeInfo> modes;
    std::vector<std::uint32_t> crtcs; // CRTCs that can drive it, the current one first
};

struct CrtcState {
    std::uint32_t framebuffer = 0, x = 0, y = 0;
    bool mode_valid = false;
    drmModeModeInfo mode{};
};

struct DumbBuffer {
    std::uint32_t handle = 0, pitch = 0; // the pitch is the kernel's choice
    std::uint64_t size = 0;
};

struct FlipEvent {
    std::uint64_t tag = 0;      // the tag that flip() got
    std::uint32_t sequence = 0; // counts refreshes; drivers without a vertical blank say 0
    std::int64_t time_ns = 0;   // of the refresh, CLOCK_MONOTONIC
};

class Device {
public:
    virtual ~Device() = default;

    virtual std::string driver() = 0;
    virtual bool has_dumb_buffers() = 0;
    // Master: the right to set modes. EBUSY or EACCES when another process has it.
    virtual Errno take_master() = 0;
    // EOPNOTSUPP for a card without KMS (a render-only GPU).
    virtual Errno connectors(std::vector<Connector>& connectors) = 0;

    virtual Errno crtc(std::uint32_t crtc, CrtcState& state) = 0;
    virtual Errno set_crtc(std::uint32_t crtc, std::uint32_t connector, const CrtcState& state) = 0;

    virtual Errno create_dumb(int width, int height, int bits_per_pixel, DumbBuffer& buffer) = 0;
    virtual void destroy_dumb(std::uint32_t handle) = 0;
    virtual Errno map(const DumbBuffer& buffer, std::uint8_t*& memory) = 0;
    virtual void unmap(std::uint8_t* memory, const DumbBuffer& buffer) = 0;
    virtual Errno add_framebuffer(int width, int height, int depth, int bits_per_pixel,
                                  const DumbBuffer& buffer, std::uint32_t& framebuffer) = 0;
    virtual void remove_framebuffer(std::uint32_t framebuffer) = 0;

    // Shows the framebuffer from the next refresh on; an event with `tag` tells when.
    virtual Errno flip(std::uint32_t crtc, std::uint32_t framebuffer, std::uint64_t tag) = 0;
    // For drivers that copy: reports an area of a shown framebuffer that was drawn. ENOSYS
    // elsewhere.
    virtual Errno dirty(std::uint32_t framebuffer, std::span<const image::Rect> damage) = 0;

    virtual int event_fd() const = 0;
    // Appends the events that have come; does not wait.
    virtual Errno read_events(std::vector<FlipEvent>& events) = 0;
};

} // namespace scanout::drm
