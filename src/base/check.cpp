#include "base/check.h"

#include "base/exit_code.h"

#include <cstdio>
#include <cstdlib>

namespace scanout {

void check_failed(const char* file, int line, const char* condition, const std::string& values) {
    std::fprintf(stderr, "scanout: internal error: %s:%d: %s is false%s%s\n", file, line, condition,
                 values.empty() ? "" : " with ", values.c_str());
    std::fflush(stderr);
    std::abort(); // the console's fatal-signal handler restores the screen first
}

} // namespace scanout
