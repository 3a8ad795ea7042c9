// One load, both sides, in turns: batches of frames of the same views.
#pragma once

#include "bench/peers/clock.h"
#include "bench/peers/compare.h"
#include "bench/peers/core_limits.h"
#include "bench/peers/load.h"

#include <string>
#include <vector>

namespace scanout::bench {

struct DuelOptions {
    int width = 1920, height = 1080;
    int frames = 40;     // a side, spread over a whole turn
    bool placed = false; // the peer gets scanout's order of triangles, not the file's
    std::string save_in; // a folder for the pictures that were compared; empty: none
    std::vector<std::string> first_frame; // words for first_of_process; empty: none is drawn
};

struct Duel {
    Times theirs, ours;
    double first = 0;      // a process's first frame over its next ones (first_frame.h); 0: none
    Difference difference; // between both pictures, where four views differ most
    double fragments = 0;  // that pass the depth test in the file's order, mean of four views
    std::size_t vertices = 0, triangles = 0;
    std::uint64_t drawn = 0; // by us, left after culling
    CoreLimits core;         // medians of what was measured in all turns
    double floor = 0;        // ms, of that core (floor.h); 0: not known
    // How many times faster we are, by the time that the thread ran: other work on the machine
    // takes wall time from both.
    double ratio() const { return theirs.cpu_median() / ours.cpu_median(); }
    double wall_ratio() const { return theirs.wall_median() / ours.wall_median(); }
    // How many times what one core could do; 0: not known.
    double above_floor() const { return floor > 0 ? ours.cpu_median() / floor : 0; }
};

Result<Duel> duel(const Load& load, const scene::Scene& scene, const DuelOptions& options);

} // namespace scanout::bench
