// Keyboard, mouse, touchpad and tablet through libinput, their devices opened by the seat.
#pragma once

#include "platform/console_input.h"
#include "platform/keyboard.h"
#include "platform/seat.h"
#include "platform/translate.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

struct libinput;
struct libinput_event;
struct udev;

namespace scanout::console {

// The abilities of a device, as the kernel reports them (libevdev).
struct DeviceFacts {
    std::string name;
    bool letters = false; // a keyboard to type on, not a power button
    bool motion = false, position = false, buttons = false, wheel = false, touch = false;
};
std::string describe(const DeviceFacts& facts); // "QEMU Virtio Mouse (motion, buttons, wheel)"

class Libinput final : public ConsoleInput {
public:
    // By udev (with hotplug); if that knows no device, by path over /dev/input/event*. Fails
    // (Exit::no_display) with the reason why no device could be opened, and with advice.
    static Result<std::unique_ptr<Libinput>> open(Seat& seat, std::vector<std::string>& notes);
    ~Libinput() override;
    Libinput(const Libinput&) = delete;
    Libinput& operator=(const Libinput&) = delete;

    int event_fd() const override;
    Result<void> dispatch(std::vector<port::Event>& events) override;
    Result<void> pause(std::vector<port::Event>& events) override;
    Result<void> resume() override;
    std::string description() const override;

    // Some device here can type letters: keys need not come through the terminal.
    bool has_keyboard() const;

private:
    struct Free {
        void operator()(libinput* context) const;
        void operator()(udev* context) const;
    };
    Libinput(Seat& seat, Keyboard keyboard) : seat_(seat), keyboard_(std::move(keyboard)) {}
    Result<void> open_by_udev();
    Result<void> open_by_path();
    std::string refusal() const;
    void collect(std::vector<port::Event>& events);
    void translate(libinput_event* event, std::vector<port::Event>& events);
    int open_restricted(const std::string& path);
    void close_restricted(int fd);

    Seat& seat_;
    Keyboard keyboard_;
    Scroll scroll_;
    std::string backend_;
    std::map<std::string, DeviceFacts> facts_;   // opened, by the kernel's name (event3)
    std::map<std::string, DeviceFacts> devices_; // devices in use
    std::map<std::string, int> refused_;         // path -> errno
    std::unique_ptr<udev, Free> udev_;
    std::unique_ptr<libinput, Free> context_;
};

} // namespace scanout::console
