#include "platform/device_calls.h"

#include <atomic>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/mman.h>

namespace scanout::console {
namespace {

constinit const DeviceCalls kKernel{
    .open = [](const char* path, int flags) { return ::open(path, flags | O_CLOEXEC); },
    .control = [](int fd, unsigned long request,
                  void* argument) { return ::ioctl(fd, request, argument); },
    .map =
        [](std::size_t size, int fd, std::int64_t offset) {
            return ::mmap(nullptr, size, PROT_WRITE, MAP_SHARED, fd, static_cast<off_t>(offset));
        }};
constinit std::atomic<const DeviceCalls*> used{&kKernel};
static_assert(std::atomic<const DeviceCalls*>::is_always_lock_free);

} // namespace

const DeviceCalls& device_calls() {
    return *used;
}

void set_device_calls(const DeviceCalls* calls) {
    used = calls != nullptr ? calls : &kKernel;
}

// Some requests take a number in the place of the pointer.
int control(int fd, unsigned long request, unsigned long number) {
    return device_calls().control(fd, request, reinterpret_cast<void*>(number));
}

} // namespace scanout::console
