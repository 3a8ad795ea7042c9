// The ladder of an axis: all its rungs, each with the error and the time of the picture that it
// draws, everything else as it is asked for. Axes and rungs are those of src/techniques.h: a new
// one joins by itself.
#pragma once

#include "measure/points.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::measure {

struct LadderRung {
    std::string_view technique;
    std::optional<std::size_t> point; // of Points; nothing where the plan refuses it
    std::string refusal;
    std::optional<double> own = {}; // what the axis's own measure says (own_measure.h)
    bool is_drawn() const { return point.has_value() || !refusal.empty(); }
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

// The axis whose pictures are of another look than those of its first rung, which is what the plan
// chooses by itself: it has a ladder where another one is asked for.
inline constexpr std::string_view kOnRequest = "ambient_occlusion";

// What is asked for, but for rungs: of each axis the technique that the plan would choose by
// itself. Models and filters stay, and what comes only on request, for the reference knows them.
frame::FrameOptions without_rungs(const frame::FrameOptions& options);

// The rungs of an axis, none of them drawn.
Ladder ladder_of(const Points& points, std::string_view axis);
// Draws the picture of a rung and compares it.
void draw(Points& points, std::string_view axis, LadderRung& rung);

} // namespace scanout::measure
