// A display: somewhere that shows whole frames. Implemented by platform/drm, platform/linux-fb and
// port/headless. The renderer draws in RAM; present() copies damaged rows in order and flips.
#pragma once

#include "base/result.h"
#include "image/image.h"
#include "image/pixel_format.h"

#include <span>
#include <string>
#include <vector>

namespace scanout::port {

struct DisplayInfo {
    std::string name; // "DRM card0 Virtual-1 (virtio_gpu)", for the info line and --verbose
    int width = 0, height = 0;
    image::PixelFormat format;
    double refresh_hz = 60;
    // Whoever shows the frame draws a pointer on it, as a terminal's window does.
    bool has_pointer = false;
    // Letters of the overlays come by show_text(), and are not in the frame.
    bool has_letters = false;
};

// A line of text on the frame: UTF-8 with its upper left corner at (x, y), pixels.
struct TextLine {
    int x = 0, y = 0, height = 0;
    std::string text;
    image::Rgba8 colour;
    friend bool operator==(const TextLine&, const TextLine&) = default;
};

class Display {
public:
    virtual ~Display() = default;
    // Its size may be another one after a dispatch() of the display or of its input, as that of a
    // window; the next frame has it.
    virtual const DisplayInfo& info() const = 0;

    // True when present() would not have to wait for an earlier frame's flip.
    virtual bool ready() const = 0;

    // Shows `frame` (of the display's size). `damage`: the rectangles that differ from the frame
    // presented last; empty means nothing differs. The first frame and the first one after
    // lost() == true are always shown whole. Call only when ready().
    virtual Result<void> present(const image::Image& frame,
                                 std::span<const image::Rect> damage) = 0;

    // Of a display that has letters: all lines on the frame that is presented next.
    virtual void show_text(std::vector<TextLine> lines) { (void)lines; }

    // True when ready() follows the display's refresh, so that waiting for it paces the loop.
    // False: the loop holds the pace itself, by a timer of info().refresh_hz. Known after the first
    // frames.
    virtual bool paced() const = 0;

    // When the frame presented last reached the screen, CLOCK_MONOTONIC ns, where the display
    // tells; 0: it does not, and the time when ready() is true again stands for it (of a terminal:
    // when it has answered that it read the frame). Of use once ready().
    virtual std::int64_t shown_at_ns() const { return 0; }

    // A descriptor to wait on for reading, -1 when there is none; dispatch() is called when it is
    // readable. A flip that does not come within a second counts as done, an answer of a terminal
    // that does not come within ten likewise.
    virtual int event_fd() const = 0;
    virtual Result<void> dispatch() = 0;

    // The console was switched away (or the display taken by someone else): drawing must stop until
    // this is false again; then the whole frame is due at once, even if nothing has changed. Ask
    // after every dispatch() of the display and of the console's session.
    virtual bool lost() const = 0;

    // Something else has been on the screen since the last present(): a whole frame is due. Also
    // where the console went and came back between two questions, so that lost() never was true.
    virtual bool stale() const { return false; }
};

} // namespace scanout::port
