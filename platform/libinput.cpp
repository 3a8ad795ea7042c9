#include "platform/libinput.h"

#include "platform/device_calls.h"

#include <libevdev/libevdev.h>
#include <libinput.h>
#include <libudev.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstring>
#include <filesystem>

#include <linux/input.h>
#include <sys/stat.h>

namespace scanout::console {
namespace {

std::string base_name(const std::string& path) {
    return path.substr(path.rfind('/') + 1);
}

DeviceFacts facts_of(int fd) {
    struct Free {
        void operator()(libevdev* device) const { libevdev_free(device); }
    };
    libevdev* raw = nullptr;
    if (libevdev_new_from_fd(fd, &raw) < 0) return {.name = "unknown device"};
    const std::unique_ptr<libevdev, Free> device(raw);
    const auto has = [&](unsigned type, unsigned code) {
        return libevdev_has_event_code(raw, type, code) != 0;
    };
    DeviceFacts facts;
    facts.name = libevdev_get_name(raw);
    facts.letters = has(EV_KEY, KEY_Q) && has(EV_KEY, KEY_C) && has(EV_KEY, KEY_LEFTCTRL);
    facts.motion = has(EV_REL, REL_X) && has(EV_REL, REL_Y);
    facts.position = has(EV_ABS, ABS_X) && has(EV_ABS, ABS_Y);
    facts.buttons = has(EV_KEY, BTN_LEFT);
    facts.wheel = has(EV_REL, REL_WHEEL);
    facts.touch = has(EV_KEY, BTN_TOUCH);
    return facts;
}

// By default libinput writes its complaints (such as "system too slow") to the console that we draw
// on. Faults that we can react to come back as errors or missing devices.
void drop_log(libinput*, libinput_log_priority, const char*, va_list) {}

// Motion must be device units, and a touchpad's tap is a click, as users expect.
void configure(libinput_device* device) {
    if (libinput_device_config_accel_is_available(device) != 0)
        libinput_device_config_accel_set_profile(device, LIBINPUT_CONFIG_ACCEL_PROFILE_FLAT);
    if (libinput_device_config_tap_get_finger_count(device) > 0)
        libinput_device_config_tap_set_enabled(device, LIBINPUT_CONFIG_TAP_ENABLED);
}

} // namespace

std::string describe(const DeviceFacts& facts) {
    std::string list;
    const auto add = [&](bool has, const char* what) {
        if (has) list += (list.empty() ? "" : ", ") + std::string(what);
    };
    add(facts.letters, "keyboard");
    add(facts.motion, "motion");
    add(facts.position, facts.touch ? "touch" : "position");
    add(facts.buttons, "buttons");
    add(facts.wheel, "wheel");
    return fmt::format("{} ({})", facts.name, list.empty() ? "keys" : list);
}

void Libinput::Free::operator()(libinput* context) const {
    libinput_unref(context);
}
void Libinput::Free::operator()(udev* context) const {
    udev_unref(context);
}

Result<std::unique_ptr<Libinput>> Libinput::open(Seat& seat, std::vector<std::string>& notes) {
    TRY(Keyboard keyboard, Keyboard::create());
    // Not make_unique: the constructor is private.
    std::unique_ptr<Libinput> input(new Libinput(seat, std::move(keyboard)));
    auto opened = input->open_by_udev();
    if (!opened) {
        notes.push_back(opened.error().what);
        TRY_VOID(input->open_by_path());
    }
    return input;
}

Libinput::~Libinput() = default;

int Libinput::open_restricted(const std::string& path) {
    const auto fd = seat_.open_device(path);
    if (!fd) {
        refused_[path] = fd.error();
        return -fd.error();
    }
    // On a console of its own the viewer mutes the keyboard. Elsewhere each key would also reach
    // whoever reads the console on the screen.
    if (!seat_.has_console() && control(*fd, EVIOCGRAB, 1) != 0) {
        refused_[path] = errno;
        seat_.close_device(*fd);
        return -refused_[path];
    }
    refused_.erase(path);
    facts_[base_name(path)] = facts_of(*fd);
    return *fd;
}

void Libinput::close_restricted(int fd) {
    seat_.close_device(fd);
}

namespace {
// The two functions by which libinput opens devices; `self` is the Libinput.
template <class Self, auto kOpen, auto kClose>
constexpr libinput_interface interface_of() {
    return {
        [](const char* path, int, void* self) { return (static_cast<Self*>(self)->*kOpen)(path); },
        [](int fd, void* self) { (static_cast<Self*>(self)->*kClose)(fd); }};
}
} // namespace

Result<void> Libinput::open_by_udev() {
    static constexpr libinput_interface kInterface =
        interface_of<Libinput, &Libinput::open_restricted, &Libinput::close_restricted>();
    udev_.reset(udev_new());
    if (!udev_) return fail(Exit::no_display, "libinput: udev cannot be asked");
    context_.reset(libinput_udev_create_context(&kInterface, this, udev_.get()));
    if (!context_) return fail(Exit::no_display, "libinput: no context");
    libinput_log_set_handler(context_.get(), drop_log);
    if (libinput_udev_assign_seat(context_.get(), "seat0") != 0)
        return fail(Exit::no_display, "libinput: seat0 cannot be assigned");
    backend_ = "udev";
    std::vector<port::Event> none;
    TRY_VOID(dispatch(none));
    if (devices_.empty()) return fail(Exit::no_display, "libinput (udev): {}", refusal());
    return {};
}

Result<void> Libinput::open_by_path() {
    static constexpr libinput_interface kInterface =
        interface_of<Libinput, &Libinput::open_restricted, &Libinput::close_restricted>();
    context_.reset(libinput_path_create_context(&kInterface, this));
    if (!context_) return fail(Exit::no_display, "libinput: no context");
    libinput_log_set_handler(context_.get(), drop_log);
    backend_ = "path";
    bool unknown = false;
    for (int i = 0; i < 32; ++i) {
        const std::string path = fmt::format("/dev/input/event{}", i);
        struct stat info {};
        if (::stat(path.c_str(), &info) != 0) continue;
        // libinput waits two seconds for each device that udev has not seen, and then refuses it.
        udev_device* device = udev_device_new_from_devnum(udev_.get(), 'c', info.st_rdev);
        const bool known = device != nullptr && udev_device_get_is_initialized(device) != 0;
        udev_device_unref(device);
        unknown = unknown || !known;
        if (known) libinput_path_add_device(context_.get(), path.c_str());
    }
    std::vector<port::Event> none;
    TRY_VOID(dispatch(none));
    if (!devices_.empty()) return {};
    if (unknown && refused_.empty())
        return fail(Exit::no_display,
                    "libinput: udev has not seen the devices in /dev/input: start udevd");
    return fail(Exit::no_display, "libinput (path): {}", refusal());
}

std::string Libinput::refusal() const {
    if (refused_.empty()) return "no input device: plug in a keyboard";
    const auto& [path, error] = *refused_.begin();
    const char* advice =
        error == EACCES || error == EPERM ? ": add the user to group input, or start seatd" : "";
    return fmt::format("{}: {}{}", path, std::strerror(error), advice);
}

int Libinput::event_fd() const {
    return libinput_get_fd(context_.get());
}

bool Libinput::has_keyboard() const {
    return std::any_of(devices_.begin(), devices_.end(),
                       [](const auto& device) { return device.second.letters; });
}

std::string Libinput::description() const {
    std::string text = fmt::format("libinput ({}), {} device{}", backend_, devices_.size(),
                                   devices_.size() == 1 ? "" : "s");
    for (const auto& [name, facts] : devices_)
        text += (name == devices_.begin()->first ? ": " : "; ") + describe(facts);
    return text + fmt::format("; layout {}", keyboard_.layout());
}

// libinput's clock is CLOCK_MONOTONIC.
static std::int64_t time_of(libinput_event* event) {
    const libinput_event_type type = libinput_event_get_type(event);
    const std::uint64_t microseconds =
        type == LIBINPUT_EVENT_KEYBOARD_KEY
            ? libinput_event_keyboard_get_time_usec(libinput_event_get_keyboard_event(event))
            : libinput_event_pointer_get_time_usec(libinput_event_get_pointer_event(event));
    return static_cast<std::int64_t>(microseconds) * 1000;
}

Result<void> Libinput::dispatch(std::vector<port::Event>& events) {
    if (const int error = libinput_dispatch(context_.get()); error != 0)
        return fail(Exit::no_display, "libinput: {}", std::strerror(-error));
    collect(events);
    return {};
}

void Libinput::collect(std::vector<port::Event>& events) {
    while (libinput_event* event = libinput_get_event(context_.get())) {
        const std::size_t before = events.size();
        translate(event, events);
        for (std::size_t i = before; i < events.size(); ++i)
            events[i].time_ns = time_of(event);
        libinput_event_destroy(event);
    }
}

Result<void> Libinput::pause(std::vector<port::Event>& events) {
    libinput_suspend(context_.get());
    collect(events);
    return keyboard_.reset();
}

Result<void> Libinput::resume() {
    if (libinput_resume(context_.get()) != 0)
        return fail(Exit::no_display, "libinput: the devices cannot be opened again: {}",
                    refusal());
    return {};
}

void Libinput::translate(libinput_event* event, std::vector<port::Event>& events) {
    libinput_device* device = libinput_event_get_device(event);
    libinput_event_pointer* pointer = nullptr;
    const auto add = [&](const std::optional<port::Event>& translated) {
        if (translated) events.push_back(*translated);
    };
    constexpr auto kVertical = LIBINPUT_POINTER_AXIS_SCROLL_VERTICAL;
    switch (libinput_event_get_type(event)) {
    case LIBINPUT_EVENT_DEVICE_ADDED: {
        configure(device);
        const std::string name = libinput_device_get_sysname(device);
        devices_[name] = facts_[name];
        return;
    }
    case LIBINPUT_EVENT_DEVICE_REMOVED:
        devices_.erase(libinput_device_get_sysname(device));
        return;
    case LIBINPUT_EVENT_KEYBOARD_KEY: {
        libinput_event_keyboard* key = libinput_event_get_keyboard_event(event);
        const bool pressed =
            libinput_event_keyboard_get_key_state(key) == LIBINPUT_KEY_STATE_PRESSED;
        return events.push_back(keyboard_.key(libinput_event_keyboard_get_key(key), pressed));
    }
    case LIBINPUT_EVENT_POINTER_MOTION:
        pointer = libinput_event_get_pointer_event(event);
        return add(motion(libinput_event_pointer_get_dx_unaccelerated(pointer),
                          libinput_event_pointer_get_dy_unaccelerated(pointer)));
    case LIBINPUT_EVENT_POINTER_MOTION_ABSOLUTE:
        pointer = libinput_event_get_pointer_event(event);
        return add(motion_absolute(libinput_event_pointer_get_absolute_x_transformed(pointer, 1),
                                   libinput_event_pointer_get_absolute_y_transformed(pointer, 1)));
    case LIBINPUT_EVENT_POINTER_BUTTON: {
        pointer = libinput_event_get_pointer_event(event);
        const auto which = button_of(libinput_event_pointer_get_button(pointer));
        const bool pressed =
            libinput_event_pointer_get_button_state(pointer) == LIBINPUT_BUTTON_STATE_PRESSED;
        if (which) add(button(*which, pressed));
        return;
    }
    // Skipped: each of these comes with a POINTER_AXIS event of the same content.
    case LIBINPUT_EVENT_POINTER_SCROLL_WHEEL:
        pointer = libinput_event_get_pointer_event(event);
        if (libinput_event_pointer_has_axis(pointer, kVertical) != 0)
            add(scroll_.wheel(libinput_event_pointer_get_scroll_value_v120(pointer, kVertical)));
        return;
    case LIBINPUT_EVENT_POINTER_SCROLL_FINGER:
    case LIBINPUT_EVENT_POINTER_SCROLL_CONTINUOUS:
        pointer = libinput_event_get_pointer_event(event);
        if (libinput_event_pointer_has_axis(pointer, kVertical) != 0)
            add(scroll_.continuous(libinput_event_pointer_get_scroll_value(pointer, kVertical)));
        return;
    default:
        return;
    }
}

} // namespace scanout::console
