#include "platform/linux-fb/display.h"

#include "platform/devices.h"
#include "platform/linux-fb/fb_display.h"

#include <cstring>
#include <filesystem>

namespace scanout::linux_fb {

namespace {

// The DRM card whose driver emulates this frame buffer: both are of one device. Else "".
std::string card_behind(const std::string& frame_buffer) {
    namespace fs = std::filesystem;
    std::error_code error;
    const std::string name = frame_buffer.substr(frame_buffer.rfind('/') + 1);
    const fs::path device = fs::canonical("/sys/class/graphics/" + name + "/device", error);
    if (error) return {};
    for (fs::directory_iterator entry("/sys/class/drm", error), end; !error && entry != end;
         entry.increment(error)) {
        const std::string card = entry->path().filename();
        if (!card.starts_with("card") || card.find('-') != std::string::npos) continue;
        std::error_code none;
        if (fs::canonical(entry->path() / "device", none) == device) return "/dev/dri/" + card;
    }
    return {};
}

} // namespace

Result<std::unique_ptr<port::Display>> create(const Options& options, console::Seat& seat) {
    // The emulation can be opened and written all the same, and nobody would see it.
    const std::string card = card_behind(options.device);
    if (!card.empty() && console::has_another_master(card))
        return fail(Exit::no_display, "{}: shows only what another program draws on {}{}",
                    options.device, card, console::held_by(card));
    TRY(std::unique_ptr<Device> device, open_device(options.device));
    return FbDisplay::create(std::move(device), options.device, seat);
}

std::vector<FrameBufferInfo> list_frame_buffers() {
    std::vector<FrameBufferInfo> list;
    for (int i = 0; i < 32; ++i) {
        FrameBufferInfo info;
        info.path = fmt::format("/dev/fb{}", i);
        std::error_code error;
        if (!std::filesystem::exists(info.path, error)) continue;
        fb_var_screeninfo variable{};
        fb_fix_screeninfo fixed{};
        auto device = open_device(info.path);
        if (!device) {
            info.problem = device.error().what;
        } else if ((*device)->variable(variable) != 0 || (*device)->fixed(fixed) != 0) {
            info.problem = fmt::format("{}: is no frame buffer", info.path);
        } else {
            info.id = std::string(fixed.id, ::strnlen(fixed.id, sizeof fixed.id));
            info.width = static_cast<int>(variable.xres);
            info.height = static_cast<int>(variable.yres);
            if (const auto layout = layout_of(variable, fixed); layout)
                info.format = layout->format;
            else
                info.problem = fmt::format("{}: {}", info.path, layout.error().what);
        }
        list.push_back(std::move(info));
    }
    return list;
}

} // namespace scanout::linux_fb
