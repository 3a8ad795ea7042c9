// The process's own memory, as the kernel counts it.
#pragma once

#include <cstdint>

namespace scanout {

std::uint64_t resident_bytes();      // now (VmRSS)
std::uint64_t peak_resident_bytes(); // the most so far (VmHWM)

} // namespace scanout
