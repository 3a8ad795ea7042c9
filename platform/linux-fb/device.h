// The seam to a frame buffer device: the few calls that a display needs. The tests play one on
// plain memory.
#pragma once

#include "base/result.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <linux/fb.h>

namespace scanout::linux_fb {

using Errno = int; // 0: done

// The colour table of a DIRECTCOLOR device, 16 bits an entry.
struct ColorTable {
    std::vector<std::uint16_t> red, green, blue;
};

class Device {
public:
    virtual ~Device() = default;
    virtual Errno variable(fb_var_screeninfo& info) = 0;
    virtual Errno fixed(fb_fix_screeninfo& info) = 0;
    // The first `size` bytes of the device's memory, for writing; unmapped with the device.
    virtual Errno map(std::size_t size, std::uint8_t*& memory) = 0;
    virtual Errno get_colors(ColorTable& table) = 0; // as many as the table has room for
    virtual Errno set_colors(const ColorTable& table) = 0;
};

// Errors: the path, the reason and what to do (Exit::no_display).
Result<std::unique_ptr<Device>> open_device(const std::string& path);

} // namespace scanout::linux_fb
