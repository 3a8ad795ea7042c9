// Where to cut two overlapping pictures (Efros and Freeman 2001).
#pragma once

#include <cstdint>
#include <vector>

namespace scanout::signal {

// The cheapest way down a strip `across` wide, rows of costs one after the other: a place a row,
// each at most one beside the last. Of equal ones the leftmost, seen from the end.
std::vector<int> cheapest_path(std::vector<std::uint32_t> cost, int across);

} // namespace scanout::signal
