// Two of our threads against one, beside two threads that only compute: what this machine's second
// core is worth at this moment.
#pragma once

#include "base/jobs.h"
#include "base/result.h"
#include "bench/peers/load.h"

namespace scanout::bench {

struct ThreadsResult {
    double ours = 0;    // speed-up: the mean of one thread on either core, least times
    double compute = 0; // of the pair
    // Of a machine whose second core is a whole one.
    double relative() const { return compute > 0 ? 2 * ours / compute : 0; }
    // Where the pair got less than a core and a half, or we more than two, other work had the rest.
    bool judged() const { return compute >= 1.5 && ours <= 2.1; }
};

// two: of two threads, made while the process may run on every core. Other work that stands in the
// way gets up to two more turns of as many rounds to leave; least times are of all of them.
Result<ThreadsResult> measure_threads(const Load& load, const scene::Scene& scene, Jobs& two,
                                      int width, int height, int rounds);

} // namespace scanout::bench
