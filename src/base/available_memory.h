// How much memory may we take? The one answer for everyone who is about to take much.
#pragma once

#include <cstdint>
#include <string>

namespace scanout {

// Bytes that this process may still take without swapping: the least of what the machine has
// (MemAvailable), what its control groups leave (v2 and v1, every group up to the root, page cache
// that can be dropped not counted) and what RLIMIT_AS leaves. The largest number when nothing
// limits it. The folders are parameters for tests.
std::uint64_t available_bytes(const std::string& proc = "/proc",
                              const std::string& cgroups = "/sys/fs/cgroup");

} // namespace scanout
