#include "bench/peers/machine.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <sched.h>

namespace scanout::bench {
namespace {

const cpu_set_t& allowed_at_start() {
    static const cpu_set_t set = [] {
        cpu_set_t now;
        CPU_ZERO(&now);
        ::sched_getaffinity(0, sizeof now, &now);
        return now;
    }();
    return set;
}

} // namespace

std::string cpu_name() {
    std::ifstream info("/proc/cpuinfo");
    std::string line, name = "unknown";
    while (std::getline(info, line))
        if (line.starts_with("model name")) {
            name = line.substr(line.find(':') + 2);
            break;
        }
    return fmt::format("{}, {} cores", name, std::thread::hardware_concurrency());
}

std::string compiler_name() {
#if defined(__clang__)
    return "clang++ " __clang_version__;
#else
    return "g++ " __VERSION__;
#endif
}

double load_average() {
    double average = 0;
    return ::getloadavg(&average, 1) == 1 ? average : 0;
}

int cores() {
    return std::max(CPU_COUNT(&allowed_at_start()), 1);
}

void stay_on_one_core(int number) {
    const cpu_set_t& all = allowed_at_start();
    int before = number % cores();
    for (int core = 0; core < CPU_SETSIZE; ++core) {
        if (!CPU_ISSET(core, &all) || before-- > 0) continue;
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(core, &one);
        ::sched_setaffinity(0, sizeof one, &one);
        return;
    }
}

void run_anywhere() {
    ::sched_setaffinity(0, sizeof(cpu_set_t), &allowed_at_start());
}

} // namespace scanout::bench
