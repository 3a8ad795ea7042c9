#include "platform/tty/held_output.h"

#include <array>
#include <cstdio>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace scanout::tty {
namespace {

struct Held {
    int descriptor;
    int terminal = -1; // a copy of the descriptor
    int kept = -1;     // the file in memory
};
std::array held_outputs{Held{STDOUT_FILENO}, Held{STDERR_FILENO}};

} // namespace

void hold_output() {
    std::fflush(stdout);
    for (Held& held : held_outputs) {
        if (held.terminal >= 0 || ::isatty(held.descriptor) == 0) continue;
        const int kept = ::memfd_create("held", MFD_CLOEXEC);
        if (kept < 0) continue;
        held.terminal = ::fcntl(held.descriptor, F_DUPFD_CLOEXEC, 3);
        if (held.terminal < 0 || ::dup2(kept, held.descriptor) < 0) {
            if (held.terminal >= 0) ::close(held.terminal);
            held.terminal = -1;
            ::close(kept);
            continue;
        }
        held.kept = kept;
    }
}

void release_output() {
    for (Held& held : held_outputs) {
        if (held.terminal < 0) continue;
        ::dup2(held.terminal, held.descriptor);
        ::close(held.terminal);
        held.terminal = -1;
        std::array<char, 4096> text;
        ::lseek(held.kept, 0, SEEK_SET);
        for (ssize_t count = 0; (count = ::read(held.kept, text.data(), text.size())) > 0;)
            if (::write(held.descriptor, text.data(), static_cast<std::size_t>(count)) != count)
                break;
        ::close(held.kept);
        held.kept = -1;
    }
}

} // namespace scanout::tty
