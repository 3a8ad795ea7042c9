// All techniques of all modules: `scanout list techniques` prints them.
#pragma once

#include "base/technique.h"
#include "shade/stage.h"

#include <string_view>
#include <vector>

namespace scanout::frame {

// In the order of techniques.h.
const std::vector<const Technique*>& techniques();
// The inputs that a technique reads of each lane; empty for techniques that are no stage or filter.
shade::Attributes reads(const Technique& technique);
std::vector<std::string_view> names_on(std::string_view axis);
// The first of them, which stands where nothing is asked for. Allocates nothing: each frame asks.
std::string_view first_on(std::string_view axis);

} // namespace scanout::frame
