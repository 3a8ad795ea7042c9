// Loading a model for a command: progress on a terminal, warnings, the time it took.
#pragma once

#include "app/options/settings.h"
#include "base/jobs.h"
#include "base/result.h"
#include "base/warnings.h"
#include "io/load.h"
#include "scene/scene.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace scanout::app {

struct LoadedModel {
    scene::Scene scene;                        // its mesh cut by --section
    std::optional<scene::SectionSpec> section; // that cut it
    std::optional<geom::Mesh> whole;           // where it is: the mesh before
    const geom::Mesh& whole_mesh() const { return whole ? *whole : scene.mesh; }
    std::vector<std::string> warnings;
    double load_ms = 0;
    io::LoadTimes load_times;                 // its parts
    scene::UpAxis up = scene::UpAxis::plus_y; // of files of its format
    io::ModelFormat format{};
    std::vector<std::string> libraries; // of materials, that were read
};

// The camera that the command line asks for; a model's format says what is up where it does not.
scene::CameraOptions camera_of(const Settings& settings, const LoadedModel& model);
// The same, where the model fits its picture if nothing says the distance (scene/fit.h).
scene::CameraOptions fitted_camera_of(const Settings& settings, const LoadedModel& model);

// `progress` is called with the fraction of the work that is done; false cancels.
// The path "-" is standard input. `source` is filled when given. reach: of --animation, where it is
// known.
Result<LoadedModel> load_model(const std::string& path, const Settings& settings, Jobs& jobs,
                               const std::function<bool(double)>& progress,
                               io::ModelSource* source = nullptr,
                               const std::optional<io::Reach>& reach = {});

// As load_model, with a progress bar on standard error when it is a terminal and loading takes
// over a second, and the warnings printed; neither with --quiet.
Result<LoadedModel> load_model_with_messages(const std::string& path, const Settings& settings,
                                             Jobs& jobs, io::ModelSource* source = nullptr);

void print_warnings(const std::vector<std::string>& warnings, const Settings& settings);
// And adds them to those of a report.
void warn(const std::vector<std::string>& warnings, const Settings& settings,
          std::vector<std::string>& report);

} // namespace scanout::app
