#include "io/memory_limit.h"

#include "base/available_memory.h"
#include "base/memory.h"
#include "io/stl/stl.h"

#include <algorithm>

namespace scanout::io {
namespace {

constexpr std::uint64_t kMegabyte = 1'000'000;

// The least memory of a facet of a binary STL file at the peak of loading: 90 bytes are measured on
// a smooth surface of two million facets, 114 on one that is all edges.
constexpr std::uint64_t kBytesPerFacet = 80;

} // namespace

MemoryLimit::MemoryLimit(std::uint64_t bytes)
    : before_(resident_bytes()), limit_(bytes != 0 ? bytes : available_bytes()) {}

Result<> MemoryLimit::admit_stl(std::string_view head, std::uint64_t size,
                                const std::string& path) const {
    const std::uint64_t facets = stl_facets_told(head, size);
    if (facets * kBytesPerFacet <= limit_) return {};
    return fail(Exit::unreadable,
                "{}: its {} triangles take at least {} MB of memory to load, and {} MB are "
                "available: close other programs, or cut the model into parts",
                path, facets, facets * kBytesPerFacet / kMegabyte, limit_ / kMegabyte);
}

bool MemoryLimit::holds(std::uint64_t left_of_file) {
    const std::uint64_t now = resident_bytes();
    const std::uint64_t taken = now > before_ ? now - before_ : 0;
    const std::uint64_t arrays = taken > left_of_file ? taken - left_of_file : 0;
    exceeded_ = exceeded_ || std::max(taken, 2 * arrays) > limit_;
    return !exceeded_;
}

} // namespace scanout::io
