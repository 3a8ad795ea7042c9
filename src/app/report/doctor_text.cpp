#include "app/report/doctor_text.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::app {
namespace {

using geom::Hazard;

// Faces that show it: its mark stands at them.
bool shows_in_pixels(Hazard hazard) {
    switch (hazard) {
    case Hazard::not_finite:
    case Hazard::collapsed_faces:
    case Hazard::cracks:
    case Hazard::zero_areas:
    case Hazard::long_normals:
    case Hazard::unreferenced:
    case Hazard::denormals:
    case Hazard::far_from_origin:
    case Hazard::unusual_unit:
        return false;
    default:
        return true;
    }
}

std::int64_t pixels_in(const measure::PixelsOfView& view, Hazard hazard) {
    if (hazard == Hazard::t_vertices) return view.through;
    if (hazard == Hazard::small_triangles) return static_cast<std::int64_t>(view.small);
    return view.shown[static_cast<std::size_t>(hazard)];
}

const measure::PixelsOfView* worst_view(const DoctorReport& report, Hazard hazard) {
    const auto& views = report.pixels.framed;
    const auto worst = std::max_element(views.begin(), views.end(), [&](auto& a, auto& b) {
        return pixels_in(a, hazard) < pixels_in(b, hazard);
    });
    return worst == views.end() ? nullptr : &*worst;
}

std::string pixels_text(const PixelsText& pixels, std::string_view what) {
    std::string text =
        fmt::format("{} in {} pixel{} here", what, pixels.here, pixels.here == 1 ? "" : "s");
    if (pixels.worst > 0)
        text += fmt::format(", {} at worst ({})", pixels.worst, pixels.worst_view);
    return text;
}

double radii(const DoctorReport& report, double file_units) {
    return file_units * report.radii_per_unit;
}

} // namespace

std::optional<PixelsText> pixels_of(const DoctorReport& report, Hazard hazard) {
    if (!shows_in_pixels(hazard)) return std::nullopt;
    PixelsText pixels;
    pixels.here = pixels_in(report.pixels.here, hazard);
    if (const auto* worst = worst_view(report, hazard)) {
        pixels.worst = pixels_in(*worst, hazard);
        if (pixels.worst > 0) pixels.worst_view = worst->view;
    }
    return pixels;
}

std::string count_text(const geom::Finding& finding) {
    const geom::HazardCard& card = card_of(finding.hazard);
    if (finding.count == 0) return fmt::format("no {}", card.name);
    return fmt::format("{} {}", finding.count, finding.count == 1 ? card.one : card.many);
}

std::uint32_t number_in_file(const DoctorReport& report, std::uint32_t index) {
    const bool from_0 =
        report.format == io::ModelFormat::ply || report.format == io::ModelFormat::off;
    return index + (from_0 ? 0 : 1);
}

std::string place_text(const DoctorReport& report, const geom::Finding& finding) {
    const geom::HazardPlace& place = finding.worst;
    std::vector<std::string> parts;
    if (place.face) parts.push_back(fmt::format("face {}", number_in_file(report, *place.face)));
    if (place.other_face)
        parts.push_back(fmt::format("with face {}", number_in_file(report, *place.other_face)));
    if (place.position && report.format != io::ModelFormat::stl) // whose vertices have no numbers
        parts.push_back(fmt::format("{} {}",
                                    finding.hazard == Hazard::long_normals ? "normal" : "vertex",
                                    number_in_file(report, *place.position)));
    if (place.at)
        parts.push_back(
            fmt::format("at {:.6g},{:.6g},{:.6g}", place.at->x, place.at->y, place.at->z));
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::optional<std::uint32_t> line_of(const DoctorReport& report, const geom::Finding& finding) {
    const auto in = [](const std::vector<std::uint32_t>& lines, std::optional<std::uint32_t> i) {
        return i && *i < lines.size() ? std::optional(lines[*i]) : std::nullopt;
    };
    if (finding.worst.face) return in(report.face_lines, finding.worst.face);
    if (finding.hazard == Hazard::long_normals) return std::nullopt; // its position is a normal
    return in(report.position_lines, finding.worst.position);
}

std::string measure_text(const geom::Finding& finding) {
    const geom::HazardCard& card = card_of(finding.hazard);
    if (card.measure.empty() || finding.count == 0) return "";
    return fmt::format(fmt::runtime(card.measure), finding.measure);
}

std::string consequence_text(const DoctorReport& report, const geom::Finding& finding) {
    if (finding.searched < 1 && finding.count == 0) return "";
    const double scale = report.pixels.pixels_per_radius;
    switch (finding.hazard) {
    case Hazard::t_vertices: {
        std::string text =
            pixels_text(*pixels_of(report, Hazard::t_vertices), "what lies behind shows");
        const auto* worst = worst_view(report, Hazard::t_vertices);
        if (worst != nullptr && worst->background > 0)
            text += fmt::format(", of these {} of the background", worst->background);
        return text;
    }
    case Hazard::cracks:
        return fmt::format("up to {:.2g} pixels wide here (projected)",
                           radii(report, finding.measure) * scale);
    case Hazard::far_from_origin:
        return fmt::format("steps of {:.2g} pixels where floats are kept as they are, {:.1g} here",
                           radii(report, finding.measure) * scale, scale * 0x1p-23);
    case Hazard::small_triangles:
        return "";
    default:
        break;
    }
    const auto pixels = pixels_of(report, finding.hazard);
    return pixels ? pixels_text(*pixels, "such faces show") : "";
}

} // namespace scanout::app
