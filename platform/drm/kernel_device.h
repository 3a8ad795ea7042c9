// The kernel's KMS card behind the seam (libdrm).
#pragma once

#include "platform/drm/device.h"
#include "platform/seat.h"

#include <memory>

namespace scanout::drm {

std::unique_ptr<Device> kernel_device(console::Device file);

} // namespace scanout::drm
