#include "app/view/frame_log.h"

#include "app/message.h"
#include "app/picture/picture.h"
#include "image/hash.h"

#include <chrono>
#include <utility>

namespace scanout::app {

void FrameLog::presented(const image::Image& frame, const frame::FrameStats& stats) {
    const int index = count_++;
    settled_ = false;
    on_its_way_ns_ = std::exchange(input_ns_, 0);
    if (!settings_.verbose && !settings_.json) return;
    const std::uint64_t hash = image::frame_hash(image::as_displayed(format_, frame));
    if (settings_.json) records_.push_back({index, hash, frame.width(), frame.height(), stats});
    if (settings_.verbose)
        pending_ = fmt::format("frame {} hash {} {}", index, image::hash_text(hash),
                               image::name_of(format_));
}

void FrameLog::reached(std::int64_t shown_at_ns) {
    if (const std::int64_t input = std::exchange(on_its_way_ns_, 0); input != 0) {
        const std::int64_t now =
            std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
        latencies_.push_back(static_cast<double>((shown_at_ns != 0 ? shown_at_ns : now) - input) *
                             1e-6);
    }
    if (pending_.empty()) return;
    say(pending_);
    if (pending_.starts_with("frame 0 ")) say("ready");
    pending_.clear();
}

void FrameLog::took(const std::string& action, std::int64_t input_ns) {
    settled_ = false;
    if (input_ns_ == 0) input_ns_ = input_ns;
    if (settings_.verbose) say("action " + action);
}

void FrameLog::settled() {
    input_ns_ = 0; // it changed nothing
    if (!std::exchange(settled_, true) && settings_.verbose) say("settled");
}

Result<void> FrameLog::dump(const image::Image& frame, const std::string& path) const {
    TRY(const PictureFormat format, picture_format(path, PictureFormat::by_name));
    const image::Image shown = image::as_displayed(format_, frame);
    const bool raw = format == PictureFormat::raw;
    TRY(const image::Bytes bytes, encode(raw ? frame : shown, format, format_));
    TRY_VOID(write_picture(path, bytes));
    say(fmt::format("frame {} hash {}", path, image::hash_text(image::frame_hash(shown))),
        settings_.json == "-" ? stderr : stdout);
    return {};
}

} // namespace scanout::app
