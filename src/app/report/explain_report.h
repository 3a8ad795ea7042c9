// The plan of a frame as a table for people; report.h has it as JSON.
#pragma once

#include "app/model_file.h"
#include "measure/explain.h"

#include <string>
#include <vector>

namespace scanout::app {

// The fact of a row, with its share of the picture: "3 of 14 materials ..., 1.8 % of pixels".
std::string because(const measure::EffectRow& row);

// Lines without line ends. A line above the table says if nothing special is called for.
// Milliseconds only if they were measured: otherwise the text does not depend on any clock.
std::vector<std::string> explain_table(const LoadedModel& model,
                                       const measure::Explanation& explanation);

struct ScreenPage {
    std::vector<std::string> lines;
    std::size_t pages = 1; // number of pages
};

// The same on a screen of so many letters and lines, for the viewer; the first `measured` rows have
// their figures. Reasons are broken into lines, lines that do not fit go to further pages (from 1
// on), and a narrow screen shows fewer columns.
ScreenPage screen_table(const measure::Explanation& explanation, std::size_t measured,
                        std::size_t letters, std::size_t lines, std::size_t page);

// The plan alone: cost and change of each effect take many frames to measure, which happens once
// the picture stands still. times: also lists how long the effects take.
ScreenPage plan_lines(const frame::FramePlan& plan, bool times, std::size_t letters,
                      std::size_t lines, std::size_t page);

} // namespace scanout::app
