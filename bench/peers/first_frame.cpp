#include "bench/peers/first_frame.h"

#include "base/large_array.h"
#include "base/memory.h"
#include "bench/peers/clock.h"
#include "bench/peers/ours.h"
#include "frame/facts/facts.h"

#include <array>
#include <cerrno>
#include <cstdlib>

#include <sys/wait.h>
#include <unistd.h>

namespace scanout::bench {
namespace {

// Has the system hold free pages that were written before. What a virtual machine writes first it
// gets from its host, which takes many times what the system takes to clear it.
void free_written_pages() {
    constexpr std::size_t kBytes = std::size_t{256} << 20, kPage = 4096;
    LargeArray<std::byte> written(kBytes);
    for (std::size_t at = 0; at < kBytes; at += kPage)
        written[at] = std::byte{1};
}

} // namespace

Result<FirstFrame> first_frame(const Load& load, int width, int height) {
    constexpr int kNext = 9;
    TRY(const scene::Scene scene, scene_of(load));
    TRY(const scene::View view, view_of(load, scene, 0, 1, width, height));
    free_written_pages();
    release_freed(); // what the scene took, too: no page is made but by the first frame
    Jobs jobs(1);
    Times facts, first, next;
    facts.add([&] { frame::facts(scene); });
    release_freed();
    Ours ours(jobs, scene, load, width, height);
    Result<void> drawn;
    first.add([&] { drawn = ours.draw(view); });
    TRY_VOID(drawn);
    for (int i = 0; i < kNext; ++i) {
        next.add([&] { drawn = ours.draw(view); });
        TRY_VOID(drawn);
    }
    return FirstFrame{first.cpu_median() / next.cpu_median(), facts.cpu_median()};
}

Result<double> first_of_process(std::vector<std::string> words) {
    words.insert(words.begin(), "bench_peers");
    std::vector<char*> argument;
    for (std::string& word : words)
        argument.push_back(word.data());
    argument.push_back(nullptr);
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) return fail(Exit::unreadable, "no pipe for a first frame");
    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(ends[1], STDOUT_FILENO);
        ::close(ends[0]);
        ::execv("/proc/self/exe", argument.data());
        ::_exit(127);
    }
    ::close(ends[1]);
    std::string printed;
    std::array<char, 64> some{};
    for (ssize_t n = 1; child > 0 && n != 0;) {
        n = ::read(ends[0], some.data(), some.size());
        if (n < 0 && errno != EINTR) break;
        if (n > 0) printed.append(some.data(), static_cast<std::size_t>(n));
    }
    ::close(ends[0]);
    int status = -1;
    while (child > 0 && ::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    const double ratio = std::strtod(printed.c_str(), nullptr);
    if (status != 0 || !(ratio > 0))
        return fail(Exit::unreadable, "a process of its own drew no first frame: status {:#x}",
                    status);
    return ratio;
}

} // namespace scanout::bench
