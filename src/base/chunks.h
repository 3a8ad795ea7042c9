// Long loops in chunks, spread over all cores.
#pragma once

#include "base/jobs.h"

#include <algorithm>
#include <cstddef>

namespace scanout {

// Calls function(begin, end, worker) for chunks of [0, count), `chunk` long but for the last, as
// Jobs::for_each does. There must be fewer than 2^31 of them.
template <class Function>
void for_chunks(Jobs& jobs, std::size_t count, std::size_t chunk, Function&& function) {
    jobs.for_each(static_cast<int>((count + chunk - 1) / chunk), [&](int index, int worker) {
        const std::size_t begin = static_cast<std::size_t>(index) * chunk;
        function(begin, std::min(begin + chunk, count), worker);
    });
}

} // namespace scanout
