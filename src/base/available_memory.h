// How much memory may this process take? The only place that answers it.
#pragma once

#include <cstdint>
#include <string>

namespace scanout {

// Bytes that this process may still take without swapping: the least of the machine's available
// memory (MemAvailable), the rest that its control groups leave (v2 and v1, every group up to the
// root; reclaimable page cache does not count as used), and the rest of RLIMIT_AS. The largest
// number when nothing limits it. The folders are parameters for tests.
std::uint64_t available_bytes(const std::string& proc = "/proc",
                              const std::string& cgroups = "/sys/fs/cgroup");

} // namespace scanout
