#include "platform/linux-fb/device.h"

#include "base/fd.h"
#include "platform/device_calls.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/mman.h>

namespace scanout::linux_fb {
namespace {

class FileDevice final : public Device {
public:
    explicit FileDevice(Fd fd) : fd_(std::move(fd)) {}
    FileDevice(const FileDevice&) = delete;
    FileDevice& operator=(const FileDevice&) = delete;
    ~FileDevice() override {
        if (memory_ != nullptr) ::munmap(memory_, size_);
    }

    Errno variable(fb_var_screeninfo& info) override { return request(FBIOGET_VSCREENINFO, &info); }
    Errno fixed(fb_fix_screeninfo& info) override { return request(FBIOGET_FSCREENINFO, &info); }
    Errno map(std::size_t size, std::uint8_t*& memory) override {
        // Only written: reading it back would be slow.
        void* mapped = console::device_calls().map(size, fd_.get(), 0);
        if (mapped == MAP_FAILED) return errno;
        memory_ = mapped;
        size_ = size;
        memory = static_cast<std::uint8_t*>(mapped);
        return 0;
    }
    Errno get_colors(ColorTable& table) override {
        fb_cmap map = describe(table);
        return request(FBIOGETCMAP, &map);
    }
    Errno set_colors(const ColorTable& table) override {
        ColorTable copy = table;
        fb_cmap map = describe(copy);
        return request(FBIOPUTCMAP, &map);
    }

private:
    template <class T>
    Errno request(unsigned long number, T* argument) const {
        return console::control(fd_.get(), number, argument) == 0 ? 0 : errno;
    }
    static fb_cmap describe(ColorTable& table) {
        fb_cmap map{};
        map.len = static_cast<std::uint32_t>(table.red.size());
        map.red = table.red.data();
        map.green = table.green.data();
        map.blue = table.blue.data();
        return map;
    }

    Fd fd_;
    void* memory_ = nullptr;
    std::size_t size_ = 0;
};

} // namespace

Result<std::unique_ptr<Device>> open_device(const std::string& path) {
    const int fd = console::device_calls().open(path.c_str(), O_RDWR);
    if (fd >= 0) return std::make_unique<FileDevice>(Fd(fd));
    const bool denied = errno == EACCES || errno == EPERM;
    return fail(Exit::no_display, "{}: {}{}", path, std::strerror(errno),
                denied ? ": add the user to group video" : "");
}

} // namespace scanout::linux_fb
