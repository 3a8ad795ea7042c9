// A machine in memory, behind console::DeviceCalls: two virtual terminals, a card and a frame
// buffer. It counts the calls, and any of them can fail.
#pragma once

#include "fake_card_file.h"
#include "platform/device_calls.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <linux/fb.h>
#include <linux/kd.h>
#include <linux/major.h>
#include <linux/vt.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/sysmacros.h>
#include <unistd.h>

namespace scanout::console {

class FakeMachine {
public:
    struct Terminal {
        int mode = KD_TEXT, keyboard = K_UNICODE;
        vt_mode switching{};
        friend bool operator==(const Terminal& a, const Terminal& b) {
            return a.mode == b.mode && a.keyboard == b.keyboard &&
                   a.switching.mode == b.switching.mode;
        }
    };

    FakeMachine() {
        machine_ = this;
        static constexpr DeviceCalls kCalls{open, control, map};
        set_device_calls(&kCalls);
        card.fails = [this](const std::string& name) { return fails("card0 " + name); };
        // DIRECTCOLOR, the only kind that has to be changed and put back.
        variable.xres = variable.xres_virtual = 8;
        variable.yres = variable.yres_virtual = 4;
        variable.bits_per_pixel = 16;
        variable.red = {11, 5, 0};
        variable.green = {5, 6, 0};
        variable.blue = {0, 5, 0};
        std::strcpy(fixed.id, "fake");
        fixed.type = FB_TYPE_PACKED_PIXELS;
        fixed.visual = FB_VISUAL_DIRECTCOLOR;
        fixed.line_length = 16;
        fixed.smem_len = 4096;
    }
    FakeMachine(const FakeMachine&) = delete;
    FakeMachine& operator=(const FakeMachine&) = delete;
    ~FakeMachine() {
        set_device_calls(nullptr);
        machine_ = nullptr;
    }

    // What goes wrong: the call of that number; with `for_good`, and all of its name behind it.
    int failing = -1;
    int error = EIO;
    bool for_good = false;

    // What has happened: "tty1 KDSETMODE KD_TEXT".
    std::vector<std::string> calls;

    // What it is.
    std::array<Terminal, 3> terminals{}; // by their number
    int shown = 1;
    bool master = false;
    drm::FakeCard card;
    fb_var_screeninfo variable{};
    fb_fix_screeninfo fixed{};
    std::array<std::uint16_t, 64> colours = colours_of_others();

    static std::array<std::uint16_t, 64> colours_of_others() {
        std::array<std::uint16_t, 64> colours{};
        colours.fill(7);
        return colours;
    }

    // Ctrl-Alt-Fn: asks whoever has the terminal on the screen. He answers by VT_RELDISP.
    void ask_for(int number) {
        if (number == shown) return;
        vt_mode& switching = terminals[static_cast<std::size_t>(shown)].switching;
        wanted_ = number;
        if (switching.mode == VT_PROCESS)
            ::raise(switching.relsig);
        else
            show(number);
    }

    // Its devices that this process has open or mapped.
    std::vector<std::string> open_devices() const {
        std::vector<std::string> open;
        for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
            if (std::string name = device_of(std::stoi(entry.path().filename())); !name.empty())
                open.push_back(std::move(name));
        std::ifstream maps("/proc/self/maps");
        for (std::string line; std::getline(maps, line);)
            if (line.find(kStart) != std::string::npos) open.push_back(std::move(line));
        return open;
    }

    // ioctl(2) of whoever does not make it by DeviceCalls: libdrm.
    static int control_any(int fd, unsigned long request, void* argument) {
        if (machine_ != nullptr && !machine_->device_of(fd).empty())
            return control(fd, request, argument);
        return static_cast<int>(::syscall(SYS_ioctl, fd, request, argument));
    }

private:
    static inline FakeMachine* machine_ = nullptr;
    static constexpr std::string_view kStart = "/memfd:fake-";
    int wanted_ = 0;
    std::map<ino_t, Fd> cards_; // of each open file of the card: where its events are written

    // A device's file is one in memory of the same name, and that of a card a socket, so that all
    // that the kernel does with descriptors is as ever. "": it is no device of ours.
    std::string device_of(int fd) const {
        struct stat status {};
        if (::fstat(fd, &status) != 0) return {};
        if (cards_.count(status.st_ino) > 0) return "card0";
        std::error_code none;
        const std::string name =
            std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(fd), none);
        if (!name.starts_with(kStart)) return {};
        return name.substr(kStart.size(), name.find(' ') - kStart.size());
    }

    bool fails(const std::string& name) {
        const int number = static_cast<int>(calls.size());
        calls.push_back(name);
        return number == failing || (for_good && failing >= 0 && number > failing &&
                                     name == calls[static_cast<std::size_t>(failing)]);
    }
    int refuse(int with) const {
        errno = with;
        return -1;
    }

    static int open(const char* path, int) {
        FakeMachine& m = *machine_;
        const std::string name = std::string(path).substr(std::string(path).rfind('/') + 1);
        if (m.fails(name + " open")) return m.refuse(m.error);
        if (name == "card0") return m.open_card();
        for (const char* known : {"tty0", "tty1", "tty2", "fb0"})
            if (name == known) return file_of(name, 8192);
        return m.refuse(ENOENT);
    }
    static int file_of(const std::string& name, std::size_t size) {
        const int fd = ::memfd_create(("fake-" + name).c_str(), MFD_CLOEXEC);
        EXPECT_EQ(::ftruncate(fd, static_cast<off_t>(size)), 0);
        return fd;
    }
    int open_card() {
        int ends[2] = {-1, -1};
        struct stat status {};
        EXPECT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends), 0);
        EXPECT_EQ(::fstat(ends[0], &status), 0);
        cards_[status.st_ino] = Fd(ends[1]);
        return ends[0];
    }

    static void* map(std::size_t size, int fd, std::int64_t offset) {
        FakeMachine& m = *machine_;
        const std::string device = m.device_of(fd);
        if (m.fails(device + " map")) {
            errno = m.error;
            return MAP_FAILED;
        }
        // Nobody looks at the pictures of a card here.
        const Fd memory(device == "card0" ? file_of("dumb", size) : ::dup(fd));
        EXPECT_EQ(offset > 0, device == "card0");
        return ::mmap(nullptr, size, PROT_WRITE, MAP_SHARED, memory.get(), 0);
    }

    static int control(int fd, unsigned long request, void* argument) {
        FakeMachine& m = *machine_;
        const std::string device = m.device_of(fd);
        if (device.starts_with("tty"))
            return m.control_terminal(std::stoi(device.substr(3)), request, argument);
        if (device == "card0") return m.control_card(request, argument);
        if (device == "fb0") return m.control_frame_buffer(request, argument);
        return ::ioctl(fd, request, argument);
    }

    int control_terminal(int number, unsigned long request, void* argument) {
        const std::string name = fmt::format("tty{} ", number);
        Terminal& terminal = terminals[static_cast<std::size_t>(number)];
        const int value = static_cast<int>(reinterpret_cast<std::uintptr_t>(argument));
        const auto call = [&](const char* what) { return fails(name + what) ? refuse(error) : 0; };
        int result = 0;
        switch (request) {
        case TIOCGDEV:
            if ((result = call("TIOCGDEV")) == 0)
                *static_cast<unsigned*>(argument) =
                    static_cast<unsigned>(makedev(TTY_MAJOR, static_cast<unsigned>(number)));
            return result;
        case VT_GETSTATE:
            if ((result = call("VT_GETSTATE")) == 0)
                static_cast<vt_stat*>(argument)->v_active = static_cast<std::uint16_t>(shown);
            return result;
        case KDGKBMODE:
            if ((result = call("KDGKBMODE")) == 0) *static_cast<int*>(argument) = terminal.keyboard;
            return result;
        case KDSKBMODE:
            if ((result = call("KDSKBMODE")) == 0) terminal.keyboard = value;
            return result;
        case KDGETMODE:
            if ((result = call("KDGETMODE")) == 0) *static_cast<int*>(argument) = terminal.mode;
            return result;
        case KDSETMODE:
            if ((result = call(value == KD_TEXT ? "KDSETMODE KD_TEXT" : "KDSETMODE KD_GRAPHICS")) ==
                0)
                terminal.mode = value;
            if (shown == number && terminal.mode == KD_TEXT) draw_console();
            return result;
        case VT_SETMODE: {
            const vt_mode& mode = *static_cast<vt_mode*>(argument);
            if ((result = call(mode.mode == VT_AUTO ? "VT_SETMODE VT_AUTO"
                                                    : "VT_SETMODE VT_PROCESS")) == 0)
                terminal.switching = mode;
            return result;
        }
        case VT_RELDISP:
            if ((result = call(value == VT_ACKACQ ? "VT_RELDISP VT_ACKACQ" : "VT_RELDISP")) == 0 &&
                value == 1 && wanted_ != 0)
                show(std::exchange(wanted_, 0));
            return result;
        default:
            ADD_FAILURE() << name << "has no request " << request;
            return refuse(ENOTTY);
        }
    }
    void show(int number) {
        shown = number;
        draw_console();
        const vt_mode& switching = terminals[static_cast<std::size_t>(number)].switching;
        if (switching.mode == VT_PROCESS) ::raise(switching.acqsig);
    }

    // The kernel's own, where no program has the card.
    void draw_console() {
        const std::vector<std::string> open = open_devices();
        master = master && std::count(open.begin(), open.end(), "card0") > 0;
        if (!master) card.crtc.framebuffer = 99;
    }

    int control_card(unsigned long request, void* argument) {
        const bool takes = request == DRM_IOCTL_SET_MASTER;
        if (takes || request == DRM_IOCTL_DROP_MASTER) {
            if (fails(takes ? "card0 SET_MASTER" : "card0 DROP_MASTER")) return refuse(error);
            master = takes;
            return 0;
        }
        if (request == DRM_IOCTL_AUTH_MAGIC) return refuse(master ? EINVAL : EACCES);
        drm::CardFile file(card);
        if (const int failed = file.control(request, argument); failed != 0) return refuse(failed);
        for (const drm_event_vblank& event : file.take_events())
            for (const auto& [inode, end] : cards_)
                (void)!::write(end.get(), &event, sizeof event);
        return 0;
    }

    int control_frame_buffer(unsigned long request, void* argument) {
        const auto call = [&](const char* what) {
            return fails(std::string("fb0 ") + what) ? refuse(error) : 0;
        };
        int result = 0;
        switch (request) {
        case FBIOGET_VSCREENINFO:
            if ((result = call("FBIOGET_VSCREENINFO")) == 0)
                *static_cast<fb_var_screeninfo*>(argument) = variable;
            return result;
        case FBIOGET_FSCREENINFO:
            if ((result = call("FBIOGET_FSCREENINFO")) == 0)
                *static_cast<fb_fix_screeninfo*>(argument) = fixed;
            return result;
        case FBIOGETCMAP:
        case FBIOPUTCMAP: {
            const bool puts = request == FBIOPUTCMAP;
            if ((result = call(puts ? "FBIOPUTCMAP" : "FBIOGETCMAP")) != 0) return result;
            const fb_cmap& map = *static_cast<fb_cmap*>(argument);
            EXPECT_EQ(map.len, colours.size());
            puts ? std::copy_n(map.red, colours.size(), colours.begin())
                 : std::copy_n(colours.begin(), colours.size(), map.red);
            return 0;
        }
        default:
            return refuse(ENOTTY);
        }
    }
};

} // namespace scanout::console
