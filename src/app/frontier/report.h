// What accuracy costs, for people: sentences, tables and a plot as text. frontier_files.h has it as
// files.
#pragma once

#include "image/image.h"
#include "measure/frontier.h"

#include <cstdint>
#include <string>
#include <vector>

namespace scanout::app {

// A frontier, and all that says of what it is one.
struct FrontierReport {
    measure::Frontier found;
    std::string model_path;
    std::size_t triangles = 0;
    int width = 0, height = 0, threads = 0;
    std::string target, machine, date; // the instruction set; the processor; year-month-day, UTC
    image::Image reference;
    std::uint64_t reference_samples = 0;
    double noise = 0; // of the reference: root of the mean square standard error, codes
    double reference_ms = 0;
    std::vector<std::string> warnings;

    bool compared() const { return !reference.pixels().empty(); } // else errors are not known
    bool timed() const { return found.points->cost().has_value(); }
    bool has_frontier() const { return !found.frontier.empty(); } // both are known
    // "--aa samples_4"; "as asked for" for nothing.
    std::string name_of(std::size_t point) const;
    // "1.24 ± 0.05", ms of a frame; the interval is that against what is asked for. "": not timed.
    std::string cpu_text(std::size_t point) const;
};

using Rows = std::vector<std::vector<std::string>>;
struct ReportTable {
    std::string title;
    Rows rows;                      // the first one holds the heads
    std::vector<std::string> notes; // lines under it
};

// Where the knee is, the dearest effect, what is free. Of what was timed.
std::vector<std::string> frontier_sentences(const FrontierReport& report);
// Equal time, equal error, the frontier, and the ladders; without times the ladders alone.
std::vector<ReportTable> frontier_tables(const FrontierReport& report);

// Of a report that was stopped.
std::string stopped_sentence(const measure::Frontier& found);
// What was measured, on which machine: a line.
std::string frontier_head(const FrontierReport& report);
// All of it, with a plot; lines without line ends.
std::vector<std::string> frontier_text(const FrontierReport& report);

} // namespace scanout::app
