// Each system call of a session on a console fails in turn, from the first to the last: what was
// changed is changed back, and an error is one clear line.
#include "fake_machine.h"
#include "platform/console.h"
#include "platform/drm/kernel_device.h"
#include "platform/drm/open.h"
#include "platform/linux-fb/fb_display.h"
#include "platform/vt_seat.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

// libdrm finds this function in the place of the C library's.
extern "C" int ioctl_of_all(int fd, unsigned long request, void* argument) __asm__("ioctl");
int ioctl_of_all(int fd, unsigned long request, void* argument) {
    return scanout::console::FakeMachine::control_any(fd, request, argument);
}

namespace scanout::console {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

Result<std::unique_ptr<port::Display>> open_card(Seat& seat) {
    const auto open = [&](const std::string& path) -> Result<std::unique_ptr<drm::Device>> {
        const auto fd = seat.open_device(path);
        if (!fd) return fail(Exit::no_display, "{}", std::strerror(fd.error()));
        return drm::kernel_device(console::Device(seat, *fd));
    };
    TRY(std::unique_ptr<port::Display> display,
        drm::open_first({"/dev/dri/card0"}, open, {}, seat));
    return display;
}

Result<std::unique_ptr<port::Display>> open_frame_buffer(Seat& seat) {
    TRY(auto device, linux_fb::open_device("/dev/fb0"));
    TRY(std::unique_ptr<port::Display> display,
        linux_fb::FbDisplay::create(std::move(device), "/dev/fb0", seat));
    return display;
}

using OpenDisplay = Result<std::unique_ptr<port::Display>> (*)(Seat&);

Result<void> show(port::Display& display) {
    const image::Rect whole{0, 0, display.info().width, display.info().height};
    if (display.ready()) TRY_VOID(display.present(image::Image(whole.x1, whole.y1), {&whole, 1}));
    return display.dispatch();
}

// A session: frames, away to another console and back, suspended and continued, and the end.
Result<void> run(FakeMachine& machine, OpenDisplay open_display,
                 const std::function<void()>& at_end) {
    TRY(Console console, Console::open_active());
    TRY_VOID(console.refuse_if_drawn_on());
    TRY(const std::unique_ptr<Seat> seat, open_vt_seat(console));
    TRY(const std::unique_ptr<port::Display> display, open_display(*seat));
    seat->set_terminal_keyboard(false);
    TRY_VOID(show(*display));
    TRY_VOID(show(*display));
    for (const int number : {2, 1}) {
        machine.ask_for(number);
        TRY_VOID(seat->dispatch());
        TRY_VOID(show(*display));
    }
    TRY_VOID(seat->text());
    TRY_VOID(seat->graphics());
    TRY_VOID(show(*display));
    at_end();
    return {};
}

// Those that were raised and not read stay pending; they are blocked.
void forget_signals() {
    sigset_t pending;
    ::sigpending(&pending);
    const timespec none{};
    for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal)
        if (sigismember(&pending, signal) == 1) {
            sigset_t one;
            sigemptyset(&one);
            sigaddset(&one, signal);
            while (::sigtimedwait(&one, nullptr, &none) == signal) {
            }
        }
}

Result<void> session(
    FakeMachine& machine, OpenDisplay open_display, const std::function<void()>& at_end = [] {}) {
    auto result = run(machine, open_display, at_end);
    forget_signals();
    return result;
}

// But for what the failing call itself was to bring back: the last of its name, or for good.
void expect_restored(const FakeMachine& machine) {
    std::string lost;
    if (machine.failing >= 0) {
        const auto call = machine.calls.begin() + machine.failing;
        if (machine.for_good ||
            std::find(call + 1, machine.calls.end(), *call) == machine.calls.end())
            lost = *call;
    }
    const auto came_back = [&](const char* by, bool as_before) {
        EXPECT_TRUE(as_before || lost == by) << by;
    };
    const FakeMachine::Terminal& terminal = machine.terminals[1];
    came_back("tty1 KDSETMODE KD_TEXT", terminal.mode == KD_TEXT);
    came_back("tty1 KDSKBMODE", terminal.keyboard == K_UNICODE);
    came_back("tty1 VT_SETMODE VT_AUTO", terminal.switching.mode == VT_AUTO);
    came_back("card0 set_crtc", machine.card.crtc.framebuffer == 99);
    came_back("fb0 FBIOPUTCMAP", machine.colours == FakeMachine::colours_of_others());
    EXPECT_EQ(machine.terminals[2], FakeMachine::Terminal()) << "of nobody's concern";
    EXPECT_TRUE(machine.card.everything_freed());
    EXPECT_THAT(machine.open_devices(), IsEmpty());
}

void expect_one_line(const Error& error) {
    EXPECT_EQ(error.what.find('\n'), std::string::npos) << error.what;
    EXPECT_TRUE(error.exit == Exit::no_display || error.exit == Exit::unreadable) << error.what;
    EXPECT_THAT(error.what, testing::AnyOf(HasSubstr("tty"), HasSubstr("/dev/"), HasSubstr("DRM")));
}

class FailingCalls : public testing::TestWithParam<std::pair<const char*, OpenDisplay>> {};

TEST_P(FailingCalls, LeaveTheConsoleAsItWasAndOneLine) {
    const OpenDisplay open_display = GetParam().second;
    std::size_t count = 0;
    {
        FakeMachine machine;
        ASSERT_TRUE(session(machine, open_display));
        expect_restored(machine);
        count = machine.calls.size();
        EXPECT_GT(count, 25U);
    }
    for (const int error : {EIO, EACCES, ENODEV})
        for (const bool for_good : {false, true})
            for (std::size_t call = 0; call < count; ++call) {
                FakeMachine machine;
                machine.failing = static_cast<int>(call);
                machine.error = machine.card.error = error;
                machine.for_good = for_good;
                const auto result = session(machine, open_display);
                ASSERT_GT(machine.calls.size(), call);
                SCOPED_TRACE(fmt::format("{}: {}{}: {}", call, machine.calls[call],
                                         for_good ? " for good" : "", std::strerror(error)));
                expect_restored(machine);
                if (!result) expect_one_line(result.error());
                if (HasFailure()) return;
            }
}

TEST_P(FailingCalls, LeaveAWayBackToAHandler) {
    std::size_t end = 1;
    for (std::size_t call = 0; call < end; ++call) {
        FakeMachine machine;
        machine.failing = static_cast<int>(call);
        bool at_end = false;
        (void)session(machine, GetParam().second, [&] {
            at_end = true;
            end = machine.calls.size();
            restore_now();
            EXPECT_EQ(machine.terminals[1], FakeMachine::Terminal()) << machine.calls[call];
        });
        if (!at_end) end = std::max(end, call + 2); // it ended before
    }
    EXPECT_GT(end, 25U);
}

INSTANTIATE_TEST_SUITE_P(Displays, FailingCalls,
                         testing::Values(std::pair<const char*, OpenDisplay>("card", open_card),
                                         std::pair<const char*, OpenDisplay>("frame_buffer",
                                                                             open_frame_buffer)),
                         [](const auto& row) { return std::string(row.param.first); });

} // namespace
} // namespace scanout::console
