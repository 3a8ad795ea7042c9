// The ladder of an axis: all its rungs, each with the error and the time of the picture that it
// draws, everything else as it is asked for. Axes and rungs are those of src/techniques.h: a new
// one joins by itself.
#pragma once

#include "measure/points.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::measure {

struct LadderRung {
    std::string_view technique;
    std::optional<std::size_t> point; // of Points; nothing where the plan refuses it
    std::string refusal;
};

struct Ladder {
    std::string_view axis;
    std::vector<LadderRung> rungs; // as in src/techniques.h, cheapest first
    std::string left_out;          // why nothing is measured; empty: it is
    // The scene does not call for the axis: all rungs run the same stages.
    bool is_flat() const;
};

// The axes with rungs to choose from, in the order of techniques.h.
std::vector<std::string_view> ladder_axes();

// What is asked for, but for rungs: of each axis the technique that the plan would choose by
// itself. Models and filters stay, for the reference knows them.
frame::FrameOptions without_rungs(const frame::FrameOptions& options);

// Draws and compares every rung. Ends early where `stop` says so: then rungs are missing.
Ladder ladder(Points& points, std::string_view axis, const std::function<bool()>& stop);

} // namespace scanout::measure
