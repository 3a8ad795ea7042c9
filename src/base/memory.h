// The process's own memory and the machine's, as the kernel counts it.
#pragma once

#include <cstdint>

namespace scanout {

std::uint64_t resident_bytes();      // now (VmRSS)
std::uint64_t peak_resident_bytes(); // the most so far (VmHWM)
std::uint64_t available_bytes();     // of the machine, without swapping; 0: not known

} // namespace scanout
