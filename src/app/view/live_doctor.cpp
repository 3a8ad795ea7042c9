#include "app/view/live_doctor.h"

#include "app/model_file.h"
#include "app/overlay/text_block.h"
#include "app/report/doctor_text.h"
#include "geom/diagnose/diagnose.h"
#include "geom/triangulate.h"
#include "scene/view.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace scanout::app {

static std::optional<HazardSpot> spot_of(const geom::HazardPlace& place,
                                         const geom::PolygonMesh& mesh) {
    if (!place.at) return std::nullopt;
    HazardSpot spot{*place.at, DVec3(0)};
    if (!place.face) return spot;
    std::vector<DVec3> polygon;
    for (std::size_t c = mesh.face_begin[*place.face]; c < mesh.face_end(*place.face); ++c)
        polygon.push_back(mesh.positions[static_cast<std::size_t>(mesh.corners[c].position)]);
    const DVec3 normal = geom::newell_normal(polygon);
    const double length = std::sqrt(dot3(normal, normal));
    if (length > 0 && length < 1e300) spot.normal = normal / length;
    return spot;
}

void LiveDoctor::examine(const std::string& path, const Settings& settings, Jobs& jobs,
                         int generation, bool steady, const std::function<bool(double)>& progress) {
    findings_.clear();
    places_.clear();
    error_.clear();
    generation_ = generation;
    const Result<void> done = read(path, settings, jobs, steady, progress);
    if (!done) error_ = done.error().what;
}

Result<void> LiveDoctor::read(const std::string& path, const Settings& settings, Jobs& jobs,
                              bool steady, const std::function<bool(double)>& progress) {
    constexpr double kReading = 0.3; // share of the time
    constexpr double kSeconds = 10;  // of search, where somebody waits
    if (path == "-")
        return fail(Exit::unreadable, "standard input cannot be read a second time to look for "
                                      "hazards; save it, and show the file");
    io::ModelSource source;
    TRY(const LoadedModel model,
        load_model(
            path, settings, jobs, [&](double share) { return progress(share * kReading); },
            &source));
    report_ = {};
    report_.path = model.scene.path;
    report_.format = model.format;
    report_.radii_per_unit = scene::radii_per_unit(model.scene.mesh);
    geom::DiagnoseOptions how;
    how.textured = textured(model.scene.materials);
    how.seconds = steady ? 1e9 : kSeconds;
    how.progress = [&](double share) { return progress(kReading + share * (1 - kReading)); };
    report_.diagnosis = geom::diagnose(jobs, source.polygons, how);
    if (report_.diagnosis.stopped)
        return fail(Exit::unreadable, "{}: was not examined to its end", report_.path);
    findings_ = told_findings(report_);
    std::erase_if(findings_, [](const geom::Finding& finding) { return finding.count == 0; });
    for (const geom::Finding& finding : findings_)
        places_.push_back(spot_of(finding.worst, source.polygons));
    return {};
}

std::vector<std::string> LiveDoctor::lines(std::size_t letters, std::size_t lines,
                                           int selected) const {
    if (!error_.empty()) return broken_into_lines(error_, letters);
    if (findings_.empty()) return {"nothing wrong in the file"};
    std::vector<std::string> all = {
        fmt::format("hazards in the file ({} of {}); D: the next one", selected, findings_.size())};
    std::size_t selected_line = 0;
    for (std::size_t i = 0; i < findings_.size(); ++i) {
        const geom::Finding& finding = findings_[i];
        const geom::HazardCard& card = card_of(finding.hazard);
        const bool here = static_cast<int>(i) + 1 == selected;
        if (here) selected_line = all.size();
        all.push_back(fmt::format("{} {}: {}", here ? '>' : ' ', card.name, count_text(finding)));
        if (!here) continue;
        for (const std::string& part :
             {place_text(report_, finding), measure_text(finding), std::string(card.advice)})
            for (const std::string& line : broken_into_lines(part, letters > 4 ? letters - 4 : 1))
                all.push_back("    " + line);
    }
    // Where not all fit, those from the selected one on.
    if (all.size() > lines && selected_line > 1)
        all.erase(all.begin() + 1, all.begin() + static_cast<std::ptrdiff_t>(std::min(
                                                     selected_line, all.size() - lines + 1)));
    all.resize(std::min(all.size(), std::max<std::size_t>(lines, 1)));
    for (std::string& line : all)
        line.resize(std::min(line.size(), letters));
    return all;
}

} // namespace scanout::app
