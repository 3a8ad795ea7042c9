#include "platform/seat.h"

#include "platform/console.h"
#include "platform/devices.h"
#include "platform/libseat_seat.h"
#include "platform/vt_seat.h"

#include <optional>

#include <unistd.h>

namespace scanout::console {

Device::~Device() {
    if (seat_ != nullptr) seat_->close_device(fd_);
}

namespace {

// No console of ours: started over the network, from a pipe, or without the rights. Devices may be
// open to us all the same.
class DirectSeat final : public Seat {
public:
    DirectSeat() { set_active(true); }
    tl::expected<int, int> open_device(const std::string& path) override {
        auto fd = open_device_node(path);
        if (fd) cards_.opened(path, *fd);
        return fd;
    }
    void close_device(int fd) override {
        cards_.closed(fd);
        ::close(fd);
    }
    int event_fd() const override { return -1; }
    Result<void> dispatch() override { return {}; }
    Result<void> switch_session(int) override { return {}; }
    void set_terminal_keyboard(bool) override {}
    Result<void> text() override {
        set_active(false);
        cards_.drop_master();
        return {};
    }
    Result<void> graphics() override {
        cards_.set_master();
        set_active(true);
        return {};
    }
    std::string description() const override { return "no seat"; }
    bool has_console() const override { return false; }

private:
    Cards cards_;
};

std::optional<Console> find_console(std::vector<std::string>& notes) {
    for (const auto open : {Console::open_active, Console::open_own}) {
        auto opened = open();
        if (opened) return std::move(*opened);
        notes.push_back(fmt::format("console: {}", opened.error().what));
    }
    return std::nullopt;
}

} // namespace

Result<std::unique_ptr<Seat>> open_seat(std::vector<std::string>& notes) {
    // Found first: libseat changes the modes that are to be restored in the end.
    std::optional<Console> console = find_console(notes);
    if (console) {
        TRY_VOID(console->refuse_if_drawn_on());
        TRY_VOID(console->lock());
    }
    auto seat = open_libseat(console);
    if (seat) return seat;
    notes.push_back(seat.error().what);
    if (console) {
        seat = open_vt_seat(*console);
        if (seat) return seat;
        notes.push_back(seat.error().what);
    }
    return no_seat();
}

std::unique_ptr<Seat> no_seat() {
    return std::make_unique<DirectSeat>();
}

} // namespace scanout::console
