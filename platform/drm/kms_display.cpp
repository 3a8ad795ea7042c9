#include "platform/drm/kms_display.h"

#include "base/check.h"

#include <cerrno>
#include <cstring>

#include <sys/epoll.h>
#include <sys/timerfd.h>
#include <unistd.h>

namespace scanout::drm {
namespace {

constexpr image::PixelFormat kXrgb8888{32, {16, 8}, {8, 8}, {0, 8}, {24, 0}};
constexpr image::PixelFormat kRgb565{16, {11, 5}, {5, 6}, {0, 5}, {0, 0}};

Result<std::vector<Buffer>> two_buffers(Device& device, int width, int height,
                                        const image::PixelFormat& format) {
    std::vector<Buffer> buffers;
    buffers.reserve(2);
    for (int i = 0; i < 2; ++i) {
        TRY(Buffer buffer, Buffer::create(device, width, height, format));
        buffers.push_back(std::move(buffer));
    }
    return buffers;
}

bool not_master(Errno error) {
    return error == EACCES || error == EPERM;
}

} // namespace

Result<std::unique_ptr<KmsDisplay>> KmsDisplay::create(std::unique_ptr<Device> device,
                                                       Choice choice, const std::string& card,
                                                       const console::Seat& seat,
                                                       const Timeouts& timeouts) {
    const std::string name = fmt::format("DRM {} {} ({})", card.substr(card.rfind('/') + 1),
                                         choice.connector.name, device->driver());
    // Not make_unique: the constructor is private.
    std::unique_ptr<KmsDisplay> display(
        new KmsDisplay(std::move(device), std::move(choice), seat, timeouts));
    display->info_.name = name;
    if (const Errno error = display->device_->crtc(display->choice_.crtc, display->saved_);
        error != 0)
        return fail(Exit::no_display, "the CRTC cannot be read: {}", std::strerror(error));
    TRY_VOID(display->make_buffers());
    TRY_VOID(display->make_events());
    // The kernel hands out buffers filled with zeros: a black picture.
    if (const Errno error = display->set_mode(display->buffers_[0].framebuffer()); error != 0)
        return fail(Exit::no_display, "the mode {}x{} cannot be set: {}", display->info_.width,
                    display->info_.height, std::strerror(error));
    return display;
}

KmsDisplay::KmsDisplay(std::unique_ptr<Device> device, Choice choice, const console::Seat& seat,
                       const Timeouts& timeouts)
    : device_(std::move(device)), choice_(std::move(choice)), seat_(seat), timeouts_(timeouts),
      activations_(seat.activations()) {
    info_.width = choice_.mode.hdisplay;
    info_.height = choice_.mode.vdisplay;
    const double hz = refresh_hz(choice_.mode);
    info_.refresh_hz = hz >= 1 ? hz : 60;
}

// 32 bits, which nearly every driver has; else 16. Both buffers have the same layout.
Result<void> KmsDisplay::make_buffers() {
    auto buffers = two_buffers(*device_, info_.width, info_.height, kXrgb8888);
    info_.format = kXrgb8888;
    if (!buffers) {
        auto fallback = two_buffers(*device_, info_.width, info_.height, kRgb565);
        if (!fallback) return tl::unexpected<Error>(std::move(buffers).error());
        buffers = std::move(fallback);
        info_.format = kRgb565;
    }
    buffers_ = *std::move(buffers);
    return {};
}

Result<void> KmsDisplay::make_events() {
    epoll_ = Fd(::epoll_create1(EPOLL_CLOEXEC));
    timer_ = Fd(::timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK));
    if (!epoll_.valid() || !timer_.valid())
        return fail(Exit::no_display, "its events cannot be waited for: {}", std::strerror(errno));
    for (const int fd : {device_->event_fd(), timer_.get()}) {
        epoll_event event{};
        event.events = EPOLLIN;
        if (::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, fd, &event) != 0)
            return fail(Exit::internal, "epoll: {}", std::strerror(errno));
    }
    return {};
}

KmsDisplay::~KmsDisplay() {
    if (mode_was_set_ && seat_.active() && saved_.framebuffer != 0)
        device_->set_crtc(choice_.crtc, choice_.connector.id, saved_);
}

Errno KmsDisplay::set_mode(std::uint32_t framebuffer) {
    const Errno error = device_->set_crtc(choice_.crtc, choice_.connector.id,
                                          {framebuffer, 0, 0, true, choice_.mode});
    if (error != 0) return error;
    mode_was_set_ = true;
    mode_due_ = false;
    just_set_mode_ = true;
    // Drivers that copy to their screen may not do so for a mode alone; others answer ENOSYS.
    const image::Rect whole{0, 0, info_.width, info_.height};
    device_->dirty(framebuffer, {&whole, 1});
    return 0;
}

bool KmsDisplay::lost() const {
    return !seat_.active() || (taken_ && seat_.activations() == activations_);
}

bool KmsDisplay::ready() const {
    return !lost() && (!pending_ || seat_.activations() != activations_);
}

Result<void> KmsDisplay::present(const image::Image& frame, std::span<const image::Rect> damage) {
    CHECK(ready());
    CHECK_EQ(frame.width(), info_.width);
    CHECK_EQ(frame.height(), info_.height);
    shown_at_ns_ = 0; // not that of the frame before, whichever way this one takes
    if (activations_ != seat_.activations()) {
        activations_ = seat_.activations();
        pending_ = busy_ = taken_ = false;
        mode_due_ = true;
    }
    for (Buffer& buffer : buffers_)
        mode_due_ ? buffer.damage_all() : buffer.damage(damage);
    if (mode_due_) return show_by_mode(frame);
    if (!flips_work_) return show_in_front(frame);
    buffers_[1 - front_].draw(frame, info_.format);
    return flip();
}

// Shows the frame by setting the mode: after a return to the console, and after a flip that failed
// because the mode had changed.
Result<void> KmsDisplay::show_by_mode(const image::Image& frame) {
    Buffer& back = buffers_[1 - front_];
    back.damage_all();
    back.draw(frame, info_.format);
    // Failing here is no reason to end: another program took the card, or the display was
    // unplugged. It is tried again every second.
    if (set_mode(back.framebuffer()) != 0)
        lose();
    else
        flipped();
    return {};
}

Result<void> KmsDisplay::show_in_front(const image::Image& frame) {
    Buffer& front = buffers_[front_];
    const auto drawn = front.draw(frame, info_.format);
    const Errno error = device_->dirty(front.framebuffer(), drawn);
    if (not_master(error)) lose();
    return {};
}

// Shows the back buffer, which has been drawn.
Result<void> KmsDisplay::flip() {
    Buffer& back = buffers_[1 - front_];
    const Errno error = device_->flip(choice_.crtc, back.framebuffer(), ++tag_);
    busy_ = error == EBUSY;
    if (error == 0 || busy_) {
        pending_ = true;
        arm(busy_ ? timeouts_.busy : timeouts_.flip);
        return {};
    }
    if (not_master(error)) {
        lose();
        return {};
    }
    if (error == ENODEV) return failed("page flip", error);
    // The connector or its mode has changed, or the driver has no page flips at all.
    if (just_set_mode_) flips_work_ = false;
    if (set_mode(back.framebuffer()) != 0)
        lose();
    else
        flipped();
    return {};
}

void KmsDisplay::flipped() {
    front_ = 1 - front_;
    pending_ = busy_ = false;
    arm(std::chrono::milliseconds(0));
}

void KmsDisplay::lose() {
    pending_ = busy_ = false;
    taken_ = mode_due_ = true;
    arm(timeouts_.lost);
}

Result<void> KmsDisplay::dispatch() {
    std::vector<FlipEvent> events;
    if (const Errno error = device_->read_events(events); error != 0)
        return failed("events", error);
    for (const FlipEvent& event : events) {
        if (!pending_ || busy_ || event.tag != tag_) continue;
        // Drivers without a vertical blank report every flip at once, always as number 0.
        paced_ = event.sequence != 0 && event.sequence != sequence_;
        sequence_ = event.sequence;
        shown_at_ns_ = event.time_ns;
        just_set_mode_ = false;
        flipped();
    }
    std::uint64_t expirations = 0;
    if (::read(timer_.get(), &expirations, sizeof expirations) != sizeof expirations) return {};
    return timed_out();
}

Result<void> KmsDisplay::timed_out() {
    if (taken_) {
        taken_ = false;
        return {};
    }
    if (!pending_ || !seat_.active() || seat_.activations() != activations_) return {};
    if (busy_) return flip();
    // No event within a second. Setting the mode waits for the hardware: afterwards it is certain
    // which buffer is on the screen, and the late event is recognised by its old tag.
    ++tag_;
    if (set_mode(buffers_[1 - front_].framebuffer()) != 0)
        lose();
    else
        flipped();
    return {};
}

// 0 disarms.
void KmsDisplay::arm(std::chrono::milliseconds delay) const {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(delay);
    itimerspec time{};
    time.it_value.tv_sec = seconds.count();
    time.it_value.tv_nsec = std::chrono::nanoseconds(delay - seconds).count();
    ::timerfd_settime(timer_.get(), 0, &time, nullptr);
}

tl::unexpected<Error> KmsDisplay::failed(const char* call, Errno error) const {
    return fail(Exit::no_display, "{}: {}: {}", info_.name, call, std::strerror(error));
}

} // namespace scanout::drm
