// The table of ratios, and whether gates and goals are met.
#pragma once

#include "bench/peers/duel.h"
#include "bench/peers/threads.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace scanout::bench {

struct Report {
    std::string cpu, compiler, peer, target; // versions
    double load_before = 0, load_after = 0;  // of the machine
    int width = 0, height = 0;
    std::vector<std::pair<Load, Duel>> duels;
    std::vector<std::pair<Load, ThreadsResult>> threads;
};

inline constexpr double kThreadsGate = 1.7, kThreadsGoal = 1.9;
inline constexpr double kFirstGate = 2, kFirstGoal = 1.2;

// Gates that were missed, and pictures that differ: one line each. Loads without a gate count for
// their picture alone.
std::vector<std::string> missed_gates(const Report& report);

std::string to_markdown(const Report& report);
std::string to_json(const Report& report);

} // namespace scanout::bench
