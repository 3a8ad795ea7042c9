// What a run reports as JSON: one object a run (docs/report.schema.json).
#pragma once

#include "app/frontier/budget.h"
#include "app/model_file.h"
#include "app/options/settings.h"
#include "app/report/comparison.h"
#include "base/result.h"
#include "frame/renderer.h"
#include "io/load.h"
#include "measure/explain.h"
#include "scene/scene.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace scanout::app {

struct FrameRecord {
    int index = 0;
    std::uint64_t hash = 0;
    int width = 0, height = 0;
    frame::FrameStats stats;
    std::optional<std::size_t> covered_pixels = {}; // that differ from the background
};

// How sure a reference picture is.
struct ReferenceRecord {
    std::uint64_t samples = 0;
    double error = 0;              // standard, codes
    std::size_t unsure_pixels = 0; // whose error is estimated above what is wanted
};

struct RunReport {
    std::string model_path;
    scene::ModelCounts counts;
    std::vector<FrameRecord> frames;
    std::vector<ReferenceRecord> references; // of the same pictures, where they are references
    double load_ms = 0;
    io::LoadTimes load_times;
    double encode_ms = 0;                   // of the first picture
    std::vector<double> input_to_screen_ms; // of view: one a frame that follows an input
    std::optional<Chosen> chosen;           // by --budget or --max-error
    std::vector<DVec3> measured;            // points of --measure
    std::vector<std::string> warnings;
    std::uint64_t start_bytes = 0;
    int threads = 1;
};

std::string to_json(const RunReport& report);
std::string to_json(const std::vector<RunReport>& reports); // an array, in their order
std::string to_json(const Comparison& compared, const Settings& settings,
                    const std::vector<std::string>& written);
std::string to_json(const LoadedModel& model, const measure::Explanation& explanation);

// The value at which `fraction` (0 to 1) of the values are reached: nearest rank. 0 for none.
double percentile(std::vector<double> values, double fraction);

// Where --json says; nothing without it.
Result<void> write_report(const Settings& settings, const std::string& json);

} // namespace scanout::app
