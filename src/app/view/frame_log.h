// The viewer's log of its frames: a line for each that reached the display (--verbose), hashes
// (--json), and the picture files that a recording names. Hashes and files show the display's
// picture: the frame went through its pixel format.
#pragma once

#include "app/options/settings.h"
#include "app/report/report.h"
#include "base/result.h"
#include "image/image.h"
#include "port/display.h"

#include <string>
#include <vector>

namespace scanout::app {

class FrameLog {
public:
    FrameLog(const Settings& settings, const port::DisplayInfo& display)
        : settings_(settings), format_(display.format) {}

    // `frame` was handed to the display.
    void presented(const image::Image& frame, const frame::FrameStats& stats);
    // The frame handed over last is on the screen, since `shown_at_ns` (0: now): logs it, once.
    void reached(std::int64_t shown_at_ns);
    // An action came from input, which happened at `input_ns` (port::Event; 0: not known).
    void took(const std::string& action, std::int64_t input_ns);
    // What the screen shows next follows from no input: the console was away.
    void forget_inputs() { input_ns_ = on_its_way_ns_ = 0; }
    // The screen shows everything asked for: logs it, once after each action and frame.
    void settled();
    Result<void> dump(const image::Image& frame, const std::string& path) const;

    std::vector<FrameRecord> take_records() { return std::move(records_); }
    // From an input to the first frame on the screen that follows it, ms: one a frame, of its first
    // input.
    std::vector<double> take_latencies() { return std::move(latencies_); }

private:
    const Settings& settings_;
    image::PixelFormat format_;
    int count_ = 0;
    std::string pending_;
    bool settled_ = false;
    std::vector<FrameRecord> records_;
    std::int64_t input_ns_ = 0, on_its_way_ns_ = 0; // the first since a frame; that frame's
    std::vector<double> latencies_;
};

} // namespace scanout::app
