// The first card that can show something, and why each one before it cannot.
#pragma once

#include "platform/drm/device.h"
#include "platform/drm/display.h"
#include "platform/drm/kms_display.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace scanout::drm {

// A path -> its device; the error is one reason, without the path.
using OpenCard = std::function<Result<std::unique_ptr<Device>>(const std::string& path)>;

Result<std::unique_ptr<KmsDisplay>> open_first(const std::vector<std::string>& paths,
                                               const OpenCard& open, const Options& options,
                                               const console::Seat& seat,
                                               const Timeouts& timeouts = {});

} // namespace scanout::drm
