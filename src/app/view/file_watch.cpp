#include "app/view/file_watch.h"

#include "app/files.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <sys/inotify.h>
#include <unistd.h>

namespace scanout::app {

Result<FileWatch> FileWatch::create() {
    Fd fd(::inotify_init1(IN_CLOEXEC | IN_NONBLOCK));
    if (!fd.valid())
        return fail(Exit::internal, "--watch: inotify: {}; leave --watch out",
                    std::strerror(errno));
    return FileWatch(std::move(fd));
}

void FileWatch::watch(const std::vector<std::string>& paths) {
    std::map<int, std::set<std::string>> names;
    for (const std::string& path : paths) {
        const std::string folder = std::filesystem::path(path).parent_path().string();
        const int watch = ::inotify_add_watch(fd_.get(), folder.empty() ? "." : folder.c_str(),
                                              IN_CLOSE_WRITE | IN_MOVED_TO);
        if (watch >= 0) names[watch].insert(file_name_of(path));
    }
    for (const auto& [watch, old] : names_)
        if (names.count(watch) == 0) ::inotify_rm_watch(fd_.get(), watch);
    names_ = std::move(names);
}

bool FileWatch::take_changes() {
    bool changed = false;
    alignas(inotify_event) std::array<char, 4096> buffer;
    for (;;) {
        const ssize_t size = ::read(fd_.get(), buffer.data(), buffer.size());
        if (size <= 0) return changed;
        for (ssize_t at = 0; at < size;) {
            const auto* event = reinterpret_cast<const inotify_event*>(buffer.data() + at);
            at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
            if ((event->mask & IN_Q_OVERFLOW) != 0) changed = true; // something may be lost
            const auto names = names_.find(event->wd);
            changed |=
                names != names_.end() && event->len > 0 && names->second.count(event->name) > 0;
        }
    }
}

} // namespace scanout::app
