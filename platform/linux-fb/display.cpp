#include "platform/linux-fb/display.h"

#include "platform/linux-fb/fb_display.h"

#include <cstring>
#include <filesystem>

namespace scanout::linux_fb {

Result<std::unique_ptr<port::Display>> create(const Options& options, console::Seat& seat) {
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
