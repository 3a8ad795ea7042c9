// The table of ratios, and whether gates and goals are met.
#pragma once

#include "bench/peers/duel.h"
#include "bench/peers/threads.h"

#include <span>
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
    std::vector<std::pair<Load, std::string>> left_out; // and why
};

inline constexpr double kThreadsGate = 1.7, kThreadsGoal = 1.9;
// Less is better: the first frame over a steady one, and a frame over what one core could do.
inline constexpr double kFirstGate = 2, kFirstGoal = 1.2;
inline constexpr double kFloorGate = 4, kFloorGoal = 2;

// Above these both sides do not show the same (compare.h). At 1920x1080 one pixel at
// most is one side's alone; with four samples, some of which lie on edges, 0.06 % of them.
inline constexpr double kMaxFlip = 0.05, kMaxOneSided = 0.005;

// What a figure reaches: "goal met", "gate met, goal short by 1.20x", "MISSED by 1.10x".
std::string verdict(double value, double gate, double goal, bool less_is_better = false);

// Of which two threads are timed against one, too.
bool has_threads(const Load& load);
// Of depth alone it is the benchmark's own frame of floats that is made, not the renderer's.
bool has_first_frame(const Load& load);

struct Verdicts {
    // Gates that were missed, what could not be judged, and pictures that differ: one line each.
    std::vector<std::string> missed;
    int judged = 0, asked = 0; // gates: of the report's loads, and those that were left out
    bool all_met() const { return missed.empty() && judged == asked; }
};
// Both limits of pictures are gates of every load.
Verdicts judge(const Report& report);

// Gates that these loads have together, whatever was measured of them.
int gates_of(std::span<const Load> loads);

// "46 of 52 gates judged", and of those that were not, how many no one asked for.
std::string count_line(const Verdicts& verdicts, int all);

std::string to_markdown(const Report& report);
std::string to_json(const Report& report);

} // namespace scanout::bench
