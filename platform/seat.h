// The seat: who may use the screen and the input devices, and when. Through libseat where a seat
// opens (seatd, logind, or its built-in server for root); else the console itself (VtSeat); else
// devices are simply opened. All displays and inputs open their devices here.
#pragma once

#include "base/fd.h"
#include "base/result.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace scanout::console {

class Seat;

// A device that the seat opened; closes itself. The seat outlives it.
class Device {
public:
    Device() = default;
    Device(Seat& seat, int fd) : seat_(&seat), fd_(fd) {}
    Device(Device&& other) noexcept { *this = std::move(other); }
    Device& operator=(Device&& other) noexcept {
        std::swap(seat_, other.seat_);
        std::swap(fd_, other.fd_);
        return *this;
    }
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    ~Device();
    int fd() const { return fd_; }

private:
    Seat* seat_ = nullptr;
    int fd_ = -1;
};

class Seat {
public:
    virtual ~Seat() = default;

    // The console is ours to draw on. False while it is switched away or suspended.
    bool active() const { return active_; }
    // Counts how often it became ours: a display that sees it change sets its mode and draws whole.
    std::uint64_t activations() const { return activations_; }

    // Opens /dev/dri/card* or /dev/input/event* for reading and writing. The error is the errno,
    // since callers know best what to advise.
    virtual tl::expected<int, int> open_device(const std::string& path) = 0;
    virtual void close_device(int fd) = 0;

    virtual int event_fd() const = 0; // -1: nothing to wait for
    // Learns of switches. An error means that the seat is gone and the program must end.
    virtual Result<void> dispatch() = 0;

    // Shows another virtual terminal (Ctrl-Alt-Fn: the kernel does not while the keyboard is
    // muted).
    virtual Result<void> switch_session(int vt) = 0;

    // The keyboard's input to the terminal: muted once an input device is proven to work, so that
    // typed keys never reach the shell; turned on where keys must come through the terminal.
    virtual void set_terminal_keyboard(bool on) = 0;

    // Ctrl-Z: text() gives the console back to the shell; graphics() takes it again.
    virtual Result<void> text() = 0;
    virtual Result<void> graphics() = 0;

    virtual std::string description() const = 0; // "libseat on tty3"
    // True when the console is in graphics mode: nothing else draws on a frame buffer.
    virtual bool has_console() const = 0;

protected:
    void set_active(bool active) {
        if (active && !active_) ++activations_;
        active_ = active;
    }

private:
    bool active_ = false;
    std::uint64_t activations_ = 0;
};

// Opens the best seat there is: libseat, the console itself, or none (devices may be open to us all
// the same). `notes`: one line for each kind that was refused and why, for --verbose and for error
// messages. Fails (Exit::no_display) when another program draws on this console.
// Must be called before any thread exists: libseat's built-in server is a fork of this process.
Result<std::unique_ptr<Seat>> open_seat(std::vector<std::string>& notes);

// No seat: devices are opened as files. For listing them, and as the last resort.
std::unique_ptr<Seat> no_seat();

} // namespace scanout::console
