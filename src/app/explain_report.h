// The plan of a frame as a table for people; report.h has it as JSON.
#pragma once

#include "app/model_file.h"
#include "measure/explain.h"

#include <string>
#include <vector>

namespace scanout::app {

// The fact of a row, with its share of the picture: "3 of 14 materials ..., 1.8 % of pixels".
std::string because(const measure::EffectRow& row);

// Lines without line ends. A line above the table says when nothing special is called for.
// Milliseconds where they were measured: without them the text depends on no clock.
std::vector<std::string> explain_table(const LoadedModel& model,
                                       const measure::Explanation& explanation);

struct ScreenPage {
    std::vector<std::string> lines;
    std::size_t pages = 1; // that there are
};

// The same on a screen of so many letters and lines, for the viewer: `measured` rows have their
// figures. Reasons are broken into lines, what is too much goes to further pages (from 1 on), and a
// narrow screen shows fewer columns.
ScreenPage screen_table(const measure::Explanation& explanation, std::size_t measured,
                        std::size_t letters, std::size_t lines, std::size_t page);

// The plan alone: what each effect costs and changes takes many frames, and is found out once the
// picture stands still. times: how long they take, too.
ScreenPage plan_lines(const frame::FramePlan& plan, bool times, std::size_t letters,
                      std::size_t lines, std::size_t page);

} // namespace scanout::app
