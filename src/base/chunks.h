// Long loops in blocks, each on whatever core is free.
#pragma once

#include "base/jobs.h"

#include <algorithm>
#include <cstddef>

namespace scanout {

// Calls function(begin, end, worker) for blocks of [0, count), `block` long but for the last, as
// Jobs::for_each does. There must be fewer than 2^31 of them.
template <class Function>
void for_chunks(Jobs& jobs, std::size_t count, std::size_t block, Function&& function) {
    jobs.for_each(static_cast<int>((count + block - 1) / block), [&](int index, int worker) {
        const std::size_t begin = static_cast<std::size_t>(index) * block;
        function(begin, std::min(begin + block, count), worker);
    });
}

} // namespace scanout
