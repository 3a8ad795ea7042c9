// A display: somewhere that shows whole frames. Implemented by platform/drm, platform/linux-fb and
// port/headless. The renderer draws in RAM; present() copies damaged rows in order and flips.
#pragma once

#include "base/result.h"
#include "image/image.h"
#include "image/pixel_format.h"

#include <span>
#include <string>

namespace scanout::port {

struct DisplayInfo {
    std::string name;     // "DRM card0 Virtual-1 (virtio_gpu)", for the info line and --verbose
    int width = 0, height = 0;
    image::PixelFormat format;
    double refresh_hz = 60;
};

class Display {
public:
    virtual ~Display() = default;
    virtual const DisplayInfo& info() const = 0;

    // True when present() would not have to wait for an earlier frame's flip.
    virtual bool ready() const = 0;

    // Shows `frame` (of the display's size). `damage`: the rectangles that differ from the frame
    // presented last; empty means nothing differs. The first frame and the first one after
    // lost() == true are always shown whole. Call only when ready().
    virtual Result<void> present(const image::Image& frame, std::span<const image::Rect> damage) = 0;

    // A descriptor to wait on for reading, -1 when there is none (the loop then paces by its timer);
    // dispatch() is called when it is readable. A flip that does not come within a second counts as done.
    virtual int event_fd() const = 0;
    virtual Result<void> dispatch() = 0;

    // The console was switched away: drawing must stop until it comes back.
    virtual bool lost() const = 0;
};

}  // namespace scanout::port
