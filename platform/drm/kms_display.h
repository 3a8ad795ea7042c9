// The display on one card: two dumb buffers that take turns on the screen. The buffer that is
// shown, or about to be, is never written.
#pragma once

#include "base/fd.h"
#include "platform/drm/buffer.h"
#include "platform/drm/choose.h"
#include "platform/drm/device.h"
#include "platform/seat.h"
#include "port/display.h"

#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

namespace scanout::drm {

struct Timeouts {
    std::chrono::milliseconds flip{1000}; // after this a flip counts as done
    std::chrono::milliseconds busy{4};    // until a flip that met EBUSY is tried again
    std::chrono::milliseconds lost{1000}; // until a display that was taken is tried again
};

class KmsDisplay final : public port::Display {
public:
    // Sets the mode, with a black picture. On failure everything is freed and the card is as
    // before.
    static Result<std::unique_ptr<KmsDisplay>> create(std::unique_ptr<Device> device, Choice choice,
                                                      const std::string& card,
                                                      const console::Seat& seat,
                                                      const Timeouts& timeouts = {});
    KmsDisplay(const KmsDisplay&) = delete;
    KmsDisplay& operator=(const KmsDisplay&) = delete;
    ~KmsDisplay() override;

    const port::DisplayInfo& info() const override { return info_; }
    bool ready() const override;
    Result<void> present(const image::Image& frame, std::span<const image::Rect> damage) override;
    bool paced() const override { return paced_; }
    int event_fd() const override { return epoll_.get(); }
    Result<void> dispatch() override;
    bool lost() const override;
    std::int64_t shown_at_ns() const override { return shown_at_ns_; }
    bool stale() const override { return mode_due_ || activations_ != seat_.activations(); }

private:
    KmsDisplay(std::unique_ptr<Device> device, Choice choice, const console::Seat& seat,
               const Timeouts& timeouts);
    Result<void> make_buffers();
    Result<void> make_events();
    Errno set_mode(std::uint32_t framebuffer);
    Result<void> show_by_mode(const image::Image& frame);
    Result<void> show_in_front(const image::Image& frame);
    Result<void> flip();
    Result<void> timed_out();
    void flipped();
    void lose();
    void arm(std::chrono::milliseconds delay) const;
    tl::unexpected<Error> failed(const char* call, Errno error) const;

    std::unique_ptr<Device> device_;
    Choice choice_;
    const console::Seat& seat_;
    Timeouts timeouts_;
    port::DisplayInfo info_;
    CrtcState saved_;
    bool mode_was_set_ = false;
    std::vector<Buffer> buffers_;
    Fd epoll_, timer_;

    std::size_t front_ = 0;      // the buffer on the screen
    bool pending_ = false;       // the other one is to be shown: its event has not come
    bool busy_ = false;          // ... and the flip itself must be tried again
    bool flips_work_ = true;     // false: the driver has none; the front buffer is drawn on
    bool mode_due_ = false;      // the mode must be set before anything can be shown
    bool taken_ = false;         // somebody else is master, or the connector is gone
    bool just_set_mode_ = false; // a flip that fails now fails for good
    bool paced_ = false;
    std::uint64_t tag_ = 0; // of the last flip: recognises late events of earlier ones
    std::uint32_t sequence_ = 0;
    std::int64_t shown_at_ns_ = 0;  // 0: by what says no time
    std::uint64_t activations_ = 0; // of the seat, when it was last drawn on
};

} // namespace scanout::drm
