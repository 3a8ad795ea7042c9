// What a guest's tests need and busybox has not:
//   vm_helper mode TTY              prints the console's mode, its keyboard's and who switches it
//   vm_helper hold CARD             is DRM master of CARD until it is killed
//   vm_helper time-to-text TTY PID  kills PID and prints the milliseconds until TTY is in text
//   mode, and those that
//                                   the kernel takes to go from graphics to text
#include <drm.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <linux/kd.h>
#include <linux/vt.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace {

int failed(const char* what) {
    std::perror(what);
    return 1;
}

int mode_of(int tty) {
    int mode = -1;
    return ::ioctl(tty, KDGETMODE, &mode) == 0 ? mode : -1;
}

int print_mode(const char* path) {
    const int tty = ::open(path, O_RDWR | O_NOCTTY);
    int keyboard = -1;
    vt_mode switching{};
    if (tty < 0 || ::ioctl(tty, KDGKBMODE, &keyboard) != 0 ||
        ::ioctl(tty, VT_GETMODE, &switching) != 0)
        return failed(path);
    std::printf("%s %s %s\n", mode_of(tty) == KD_TEXT ? "text" : "graphics",
                keyboard == K_OFF ? "off" : "on", switching.mode == VT_AUTO ? "auto" : "process");
    return 0;
}

int hold(const char* card) {
    const int fd = ::open(card, O_RDWR);
    if (fd < 0 || ::ioctl(fd, DRM_IOCTL_SET_MASTER, 0) != 0) return failed(card);
    std::puts("held");
    std::fflush(stdout);
    for (;;)
        ::pause();
}

int time_to_text(const char* path, pid_t process) {
    const int tty = ::open(path, O_RDWR | O_NOCTTY);
    if (tty < 0) return failed(path);
    using Milliseconds = std::chrono::duration<double, std::milli>;
    auto start = std::chrono::steady_clock::now();
    if (::kill(process, SIGKILL) != 0) return failed("kill");
    while (mode_of(tty) != KD_TEXT)
        ::usleep(1000);
    const Milliseconds passed = std::chrono::steady_clock::now() - start;
    ::sleep(1); // whoever restores it may do so twice
    start = std::chrono::steady_clock::now();
    ::ioctl(tty, KDSETMODE, KD_GRAPHICS);
    ::ioctl(tty, KDSETMODE, KD_TEXT);
    const Milliseconds change = std::chrono::steady_clock::now() - start;
    std::printf("%.0f %.0f\n", passed.count(), change.count());
    return 0;
}

} // namespace

int main(int count, char** words) {
    if (count == 3 && std::strcmp(words[1], "mode") == 0) return print_mode(words[2]);
    if (count == 3 && std::strcmp(words[1], "hold") == 0) return hold(words[2]);
    if (count == 4 && std::strcmp(words[1], "time-to-text") == 0)
        return time_to_text(words[2], static_cast<pid_t>(std::atoi(words[3])));
    return 64;
}
