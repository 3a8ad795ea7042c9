#include "platform/drm/kernel_device.h"

#include "platform/device_calls.h"

#include <drm.h>
#include <xf86drm.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include <poll.h>
#include <sys/mman.h>
#include <unistd.h>

namespace scanout::drm {
namespace {

// libdrm's structures, freed by their own function.
template <auto kFree>
struct Free {
    template <class T>
    void operator()(T* object) const {
        kFree(object);
    }
};
using Resources = std::unique_ptr<drmModeRes, Free<drmModeFreeResources>>;
using ConnectorPtr = std::unique_ptr<drmModeConnector, Free<drmModeFreeConnector>>;
using EncoderPtr = std::unique_ptr<drmModeEncoder, Free<drmModeFreeEncoder>>;
using CrtcPtr = std::unique_ptr<drmModeCrtc, Free<drmModeFreeCrtc>>;
using VersionPtr = std::unique_ptr<drmVersion, Free<drmFreeVersion>>;

Errno result(int returned) {
    if (returned == 0) return 0;
    return returned == -1 ? errno : -returned; // libdrm does both
}

class KernelDevice final : public Device {
public:
    explicit KernelDevice(console::Device file) : file_(std::move(file)) {}

    std::string driver() override {
        const VersionPtr version(drmGetVersion(fd()));
        return version ? std::string(version->name) : "unknown driver";
    }
    bool has_dumb_buffers() override {
        std::uint64_t value = 0;
        return drmGetCap(fd(), DRM_CAP_DUMB_BUFFER, &value) == 0 && value != 0;
    }
    Errno take_master() override { return drmIsMaster(fd()) != 0 ? 0 : result(drmSetMaster(fd())); }

    Errno connectors(std::vector<Connector>& connectors) override {
        const Resources resources(drmModeGetResources(fd()));
        if (!resources) return errno;
        for (int i = 0; i < resources->count_connectors; ++i) {
            const ConnectorPtr raw(drmModeGetConnector(fd(), resources->connectors[i]));
            if (raw) connectors.push_back(describe(*resources, *raw));
        }
        return 0;
    }

    Errno crtc(std::uint32_t crtc, CrtcState& state) override {
        const CrtcPtr raw(drmModeGetCrtc(fd(), crtc));
        if (!raw) return errno;
        state = {raw->buffer_id, raw->x, raw->y, raw->mode_valid != 0, raw->mode};
        return 0;
    }
    Errno set_crtc(std::uint32_t crtc, std::uint32_t connector, const CrtcState& state) override {
        drmModeModeInfo mode = state.mode;
        return result(drmModeSetCrtc(fd(), crtc, state.framebuffer, state.x, state.y, &connector, 1,
                                     state.mode_valid ? &mode : nullptr));
    }

    Errno create_dumb(int width, int height, int bits_per_pixel, DumbBuffer& buffer) override {
        drm_mode_create_dumb request{};
        request.width = static_cast<std::uint32_t>(width);
        request.height = static_cast<std::uint32_t>(height);
        request.bpp = static_cast<std::uint32_t>(bits_per_pixel);
        const Errno error = result(drmIoctl(fd(), DRM_IOCTL_MODE_CREATE_DUMB, &request));
        if (error == 0) buffer = {request.handle, request.pitch, request.size};
        return error;
    }
    void destroy_dumb(std::uint32_t handle) override {
        drm_mode_destroy_dumb request{};
        request.handle = handle;
        drmIoctl(fd(), DRM_IOCTL_MODE_DESTROY_DUMB, &request);
    }
    Errno map(const DumbBuffer& buffer, std::uint8_t*& memory) override {
        drm_mode_map_dumb request{};
        request.handle = buffer.handle;
        if (drmIoctl(fd(), DRM_IOCTL_MODE_MAP_DUMB, &request) != 0) return errno;
        // Only written: reading it back would be slow at best.
        void* mapped = console::device_calls().map(buffer.size, fd(),
                                                   static_cast<std::int64_t>(request.offset));
        if (mapped == MAP_FAILED) return errno;
        memory = static_cast<std::uint8_t*>(mapped);
        return 0;
    }
    void unmap(std::uint8_t* memory, const DumbBuffer& buffer) override {
        ::munmap(memory, buffer.size);
    }
    Errno add_framebuffer(int width, int height, int depth, int bits_per_pixel,
                          const DumbBuffer& buffer, std::uint32_t& framebuffer) override {
        return result(drmModeAddFB(
            fd(), static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height),
            static_cast<std::uint8_t>(depth), static_cast<std::uint8_t>(bits_per_pixel),
            buffer.pitch, buffer.handle, &framebuffer));
    }
    void remove_framebuffer(std::uint32_t framebuffer) override { drmModeRmFB(fd(), framebuffer); }

    Errno flip(std::uint32_t crtc, std::uint32_t framebuffer, std::uint64_t tag) override {
        // The tag travels as the event's user data: a number, never followed as a pointer.
        void* user_data = nullptr;
        static_assert(sizeof user_data == sizeof tag);
        std::memcpy(&user_data, &tag, sizeof tag);
        return result(
            drmModePageFlip(fd(), crtc, framebuffer, DRM_MODE_PAGE_FLIP_EVENT, user_data));
    }
    Errno dirty(std::uint32_t framebuffer, std::span<const image::Rect> damage) override {
        std::vector<drmModeClip> clips;
        for (const image::Rect& rect : damage)
            clips.push_back(
                {static_cast<std::uint16_t>(rect.x0), static_cast<std::uint16_t>(rect.y0),
                 static_cast<std::uint16_t>(rect.x1), static_cast<std::uint16_t>(rect.y1)});
        return result(drmModeDirtyFB(fd(), framebuffer, clips.data(),
                                     static_cast<std::uint32_t>(clips.size())));
    }

    int event_fd() const override { return fd(); }
    Errno read_events(std::vector<FlipEvent>& events) override;

private:
    int fd() const { return file_.fd(); }
    Connector describe(const drmModeRes& resources, const drmModeConnector& raw);

    console::Device file_;
};

Connector KernelDevice::describe(const drmModeRes& resources, const drmModeConnector& raw) {
    const char* type = drmModeGetConnectorTypeName(raw.connector_type);
    Connector connector;
    connector.id = raw.connector_id;
    connector.name =
        fmt::format("{}-{}", type != nullptr ? type : "Unknown", raw.connector_type_id);
    connector.connected = raw.connection == DRM_MODE_CONNECTED;
    connector.modes.assign(raw.modes, raw.modes + raw.count_modes);
    const auto add = [&](std::uint32_t crtc) {
        if (crtc != 0 && std::count(connector.crtcs.begin(), connector.crtcs.end(), crtc) == 0)
            connector.crtcs.push_back(crtc);
    };
    if (const EncoderPtr current(drmModeGetEncoder(fd(), raw.encoder_id)); current)
        add(current->crtc_id);
    for (int i = 0; i < raw.count_encoders; ++i) {
        const EncoderPtr encoder(drmModeGetEncoder(fd(), raw.encoders[i]));
        for (int k = 0; encoder && k < resources.count_crtcs; ++k)
            if ((encoder->possible_crtcs & (1U << k)) != 0) add(resources.crtcs[k]);
    }
    return connector;
}

Errno KernelDevice::read_events(std::vector<FlipEvent>& events) {
    alignas(drm_event_vblank) std::array<char, 1024> bytes;
    for (pollfd state{fd(), POLLIN, 0}; ::poll(&state, 1, 0) == 1;) {
        // An unplugged card hangs up for ever.
        if ((state.revents & POLLIN) == 0) return ENODEV;
        const ssize_t count = ::read(fd(), bytes.data(), bytes.size());
        if (count < 0) return errno == EAGAIN || errno == EINTR ? 0 : errno;
        for (std::size_t at = 0; at + sizeof(drm_event) <= static_cast<std::size_t>(count);) {
            drm_event header{};
            std::memcpy(&header, bytes.data() + at, sizeof header);
            if (header.length < sizeof header) break;
            if (header.type == DRM_EVENT_FLIP_COMPLETE &&
                header.length >= sizeof(drm_event_vblank)) {
                drm_event_vblank flip{};
                std::memcpy(&flip, bytes.data() + at, sizeof flip);
                events.push_back({flip.user_data, flip.sequence,
                                  std::int64_t{flip.tv_sec} * 1'000'000'000 +
                                      std::int64_t{flip.tv_usec} * 1000});
            }
            at += header.length;
        }
    }
    return 0;
}

} // namespace

std::unique_ptr<Device> kernel_device(console::Device file) {
    return std::make_unique<KernelDevice>(std::move(file));
}

} // namespace scanout::drm
