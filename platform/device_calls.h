// The system calls on the devices of a console: virtual terminals, cards, frame buffers, keyboards.
// The tests play a machine of their own behind them, in which each call can fail. Handlers of
// signals make them, too. libdrm makes its own.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scanout::console {

struct DeviceCalls {
    int (*open)(const char* path, int flags);                      // open(2), with O_CLOEXEC
    int (*control)(int fd, unsigned long request, void* argument); // ioctl(2)
    // mmap(2), shared and only written.
    void* (*map)(std::size_t size, int fd, std::int64_t offset);
};

// The kernel's, but where a test has put others in their place.
const DeviceCalls& device_calls();
void set_device_calls(const DeviceCalls* calls); // nullptr: the kernel's

int control(int fd, unsigned long request, unsigned long number);
template <class T>
int control(int fd, unsigned long request, T* object) {
    return device_calls().control(fd, request, object);
}

} // namespace scanout::console
