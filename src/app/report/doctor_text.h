// The parts of a hazard's line, which text, JSON and SARIF share.
#pragma once

#include "app/report/doctor_report.h"

#include <cstdint>
#include <optional>
#include <string>

namespace scanout::app {

// Of a hazard whose consequence is a number of pixels: here, and in the worst framed view.
struct PixelsText {
    std::int64_t here = 0, worst = 0;
    std::string worst_view; // empty where `worst` is 0
};
// Pixels that are concerned; nothing for hazards that no pixel shows.
std::optional<PixelsText> pixels_of(const DoctorReport& report, geom::Hazard hazard);

// "6 vertices lie within other faces' edges"
std::string count_text(const geom::Finding& finding);
// "face 3, vertex 7, at 0.5,1,0"; faces and vertices count as the file's format does.
std::string place_text(const DoctorReport& report, const geom::Finding& finding);
// The line of the file at which the worst one stands: of its face, else of its vertex; nothing
// where the format has no lines.
std::optional<std::uint32_t> line_of(const DoctorReport& report, const geom::Finding& finding);
std::string measure_text(const geom::Finding& finding);
std::string consequence_text(const DoctorReport& report, const geom::Finding& finding);
// The number that the file's format gives it.
std::uint32_t number_in_file(const DoctorReport& report, std::uint32_t index);

} // namespace scanout::app
