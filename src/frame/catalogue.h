// All techniques there are, of whatever module: what `scanout list techniques` prints.
#pragma once

#include "base/technique.h"
#include "shade/stage.h"

#include <string_view>
#include <vector>

namespace scanout::frame {

// In the order of techniques.h.
const std::vector<const Technique*>& techniques();
// What a technique reads of each lane; nothing for those that are no stage and no filter.
shade::Attributes reads(const Technique& technique);
std::vector<std::string_view> names_on(std::string_view axis);

} // namespace scanout::frame
