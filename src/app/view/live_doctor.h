// The hazards of the model on show, for the viewer's panel: read from its file as it stands there,
// since the model that is drawn is mended and joined.
#pragma once

#include "app/options/settings.h"
#include "app/report/doctor_report.h"
#include "app/view/viewer.h"
#include "base/jobs.h"
#include "base/result.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace scanout::app {

class LiveDoctor {
public:
    // Examines the file of the model slot's `generation`. `progress` as in load_model; it also ends
    // the search. `steady`: the search ends by no clock, so that it finds the same in every run. A
    // file that cannot be read any more, like standard input, is what the panel says then.
    void examine(const std::string& path, const Settings& settings, Jobs& jobs, int generation,
                 bool steady, const std::function<bool(double)>& progress);
    bool knows(int generation) const { return generation == generation_; }

    // Where the worst of each hazard is; one entry a hazard, as listed.
    const std::vector<std::optional<HazardSpot>>& places() const { return places_; }
    // One line a hazard, the selected one (from 1) with place and advice; as many as fit.
    std::vector<std::string> lines(std::size_t letters, std::size_t lines, int selected) const;

private:
    Result<void> read(const std::string& path, const Settings& settings, Jobs& jobs, bool steady,
                      const std::function<bool(double)>& progress);

    std::string error_;
    int generation_ = -1;
    DoctorReport report_;
    std::vector<geom::Finding> findings_; // in the order in which they are told
    std::vector<std::optional<HazardSpot>> places_;
};

} // namespace scanout::app
