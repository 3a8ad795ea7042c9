// The ioctls of a card's file, put to a card in memory: what libdrm asks of the kernel.
#pragma once

#include "fake_card.h"

#include <drm.h>

#include <algorithm>
#include <cstring>
#include <span>

namespace scanout::drm {

class CardFile {
public:
    explicit CardFile(FakeCard& card) : card_(card) {}

    // As ioctl(2), but for the error, which is returned.
    Errno control(unsigned long request, void* argument) {
        FakeDevice device(card_);
        switch (request) {
        case DRM_IOCTL_VERSION:
            return version(of<drm_version>(argument));
        case DRM_IOCTL_GET_CAP:
            of<drm_get_cap>(argument).value = device.has_dumb_buffers() ? 1 : 0;
            return 0;
        case DRM_IOCTL_MODE_GETRESOURCES:
            return resources(of<drm_mode_card_res>(argument));
        case DRM_IOCTL_MODE_GETCONNECTOR:
            return connector(of<drm_mode_get_connector>(argument));
        case DRM_IOCTL_MODE_GETENCODER:
            return encoder(of<drm_mode_get_encoder>(argument));
        case DRM_IOCTL_MODE_GETCRTC:
            return get_crtc(device, of<drm_mode_crtc>(argument));
        case DRM_IOCTL_MODE_SETCRTC:
            return set_crtc(device, of<drm_mode_crtc>(argument));
        case DRM_IOCTL_MODE_CREATE_DUMB:
            return create_dumb(device, of<drm_mode_create_dumb>(argument));
        case DRM_IOCTL_MODE_DESTROY_DUMB:
            device.destroy_dumb(of<drm_mode_destroy_dumb>(argument).handle);
            return 0;
        case DRM_IOCTL_MODE_MAP_DUMB:
            of<drm_mode_map_dumb>(argument).offset =
                std::uint64_t{of<drm_mode_map_dumb>(argument).handle} << 16;
            return card_.call("MAP_DUMB");
        case DRM_IOCTL_MODE_ADDFB: {
            auto& fb = of<drm_mode_fb_cmd>(argument);
            return device.add_framebuffer(0, 0, 0, 0, {fb.handle, fb.pitch, 0}, fb.fb_id);
        }
        case DRM_IOCTL_MODE_RMFB:
            device.remove_framebuffer(of<std::uint32_t>(argument));
            return 0;
        case DRM_IOCTL_MODE_PAGE_FLIP: {
            const auto& flip = of<drm_mode_crtc_page_flip>(argument);
            return device.flip(flip.crtc_id, flip.fb_id, flip.user_data);
        }
        case DRM_IOCTL_MODE_DIRTYFB:
            return device.dirty(of<drm_mode_fb_dirty_cmd>(argument).fb_id, {});
        default:
            ADD_FAILURE() << "the card has no request " << request;
            return ENOTTY;
        }
    }

    // What can be read from the file now, each event of its own.
    std::vector<drm_event_vblank> take_events() {
        std::vector<drm_event_vblank> taken;
        for (const FlipEvent& event : std::exchange(card_.events, {})) {
            drm_event_vblank& raw = taken.emplace_back();
            raw.base = {DRM_EVENT_FLIP_COMPLETE, sizeof raw};
            raw.user_data = event.tag;
            raw.sequence = event.sequence;
        }
        return taken;
    }

private:
    template <class T>
    static T& of(void* argument) {
        return *static_cast<T*>(argument);
    }
    // Copies as many as there is room for, and tells how many there are.
    template <class T>
    static void give(const std::vector<T>& values, std::uint64_t to, std::uint32_t& count) {
        if (count >= values.size())
            std::copy(values.begin(), values.end(), reinterpret_cast<T*>(to));
        count = static_cast<std::uint32_t>(values.size());
    }

    Errno version(drm_version& version) {
        if (const Errno error = card_.call("VERSION"); error != 0) return error;
        constexpr std::string_view kText = "fake"; // libdrm copies each, and fails on none
        for (const auto& [text, length] : {std::pair(version.name, &version.name_len),
                                           {version.date, &version.date_len},
                                           {version.desc, &version.desc_len}}) {
            if (*length >= kText.size()) kText.copy(text, kText.size());
            *length = kText.size();
        }
        return 0;
    }

    // An encoder to each connector, which has its number.
    Errno resources(drm_mode_card_res& res) {
        if (const Errno error = card_.call("GETRESOURCES"); error != 0) return error;
        std::vector<std::uint32_t> connectors;
        for (const Connector& connector : card_.connectors)
            connectors.push_back(connector.id);
        res.count_fbs = 0;
        give(crtcs(), res.crtc_id_ptr, res.count_crtcs);
        give(connectors, res.connector_id_ptr, res.count_connectors);
        give(connectors, res.encoder_id_ptr, res.count_encoders);
        return 0;
    }
    std::vector<std::uint32_t> crtcs() const {
        std::vector<std::uint32_t> all;
        for (const Connector& connector : card_.connectors)
            all.insert(all.end(), connector.crtcs.begin(), connector.crtcs.end());
        return all;
    }
    const Connector& connector_of(std::uint32_t id) const {
        return *std::find_if(card_.connectors.begin(), card_.connectors.end(),
                             [&](const Connector& connector) { return connector.id == id; });
    }
    Errno connector(drm_mode_get_connector& raw) {
        if (const Errno error = card_.call("GETCONNECTOR"); error != 0) return error;
        const Connector& connector = connector_of(raw.connector_id);
        std::vector<drm_mode_modeinfo> modes(connector.modes.size());
        std::memcpy(modes.data(), connector.modes.data(), modes.size() * sizeof modes[0]);
        give(modes, raw.modes_ptr, raw.count_modes);
        give(std::vector{connector.id}, raw.encoders_ptr, raw.count_encoders);
        raw.count_props = 0;
        raw.encoder_id = connector.id;
        raw.connector_type = DRM_MODE_CONNECTOR_VIRTUAL;
        raw.connector_type_id = 1;
        raw.connection = connector.connected ? DRM_MODE_CONNECTED : DRM_MODE_DISCONNECTED;
        return 0;
    }
    Errno encoder(drm_mode_get_encoder& raw) {
        if (const Errno error = card_.call("GETENCODER"); error != 0) return error;
        const std::vector<std::uint32_t> all = crtcs();
        for (const std::uint32_t crtc : connector_of(raw.encoder_id).crtcs) {
            raw.crtc_id = crtc;
            raw.possible_crtcs |= 1U << (std::find(all.begin(), all.end(), crtc) - all.begin());
        }
        return 0;
    }

    static Errno get_crtc(FakeDevice& device, drm_mode_crtc& raw) {
        CrtcState state;
        if (const Errno error = device.crtc(raw.crtc_id, state); error != 0) return error;
        raw.fb_id = state.framebuffer;
        raw.x = state.x;
        raw.y = state.y;
        raw.mode_valid = state.mode_valid ? 1 : 0;
        std::memcpy(&raw.mode, &state.mode, sizeof raw.mode);
        return 0;
    }
    static Errno set_crtc(FakeDevice& device, const drm_mode_crtc& raw) {
        CrtcState state{raw.fb_id, raw.x, raw.y, raw.mode_valid != 0, {}};
        std::memcpy(&state.mode, &raw.mode, sizeof raw.mode);
        EXPECT_EQ(raw.count_connectors, 1U);
        return device.set_crtc(raw.crtc_id, 0, state);
    }
    static Errno create_dumb(FakeDevice& device, drm_mode_create_dumb& raw) {
        DumbBuffer buffer;
        const Errno error =
            device.create_dumb(static_cast<int>(raw.width), static_cast<int>(raw.height),
                               static_cast<int>(raw.bpp), buffer);
        raw.handle = buffer.handle;
        raw.pitch = buffer.pitch;
        raw.size = buffer.size;
        return error;
    }

    FakeCard& card_;
};

} // namespace scanout::drm
