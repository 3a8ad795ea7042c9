#include "app/report/doctor_report.h"

#include "app/report/doctor_text.h"
#include "app/report/json_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

namespace scanout::app {
namespace {

using geom::Finding;
using geom::Hazard;
using geom::Severity;
using Json = nlohmann::ordered_json;

std::string_view name_of(Severity severity) {
    return severity == Severity::warning ? "warning" : "note";
}

// What stands behind the hazard's name.
std::string sentence(const DoctorReport& report, const Finding& finding) {
    if (finding.searched == 0 &&
        (finding.hazard == Hazard::t_vertices || finding.hazard == Hazard::cracks))
        return "not searched for: the open edges lie too close together to tell them apart";
    std::string text = count_text(finding);
    if (finding.searched < 1)
        text += fmt::format(" in the {:.0f} % that was searched (--seconds N searches longer)",
                            finding.searched * 100);
    if (finding.count == 0) return text;
    if (finding.hazard == Hazard::small_triangles) {
        const auto pixels = *pixels_of(report, finding.hazard);
        text += fmt::format(" at worst ({}), {} here", pixels.worst_view, pixels.here);
    }
    std::vector<std::string> about;
    for (const std::string& part : {place_text(report, finding), measure_text(finding)})
        if (!part.empty()) about.push_back(part);
    if (!about.empty()) text += fmt::format(" ({})", fmt::join(about, "; "));
    if (const std::string pixels = consequence_text(report, finding); !pixels.empty())
        text += "; " + pixels;
    return text;
}

std::string counted(std::size_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string extent(const DoctorReport& report) {
    return fmt::format("{}, {}{}", counted(report.diagnosis.faces, "face"),
                       counted(report.diagnosis.triangles, "triangle"),
                       report.quick ? "; not searched for T-vertices, cracks, overlaps and "
                                      "intersections (--quick)"
                                    : "");
}

std::string summary(const DoctorReport& report, const std::vector<Finding>& findings) {
    const auto count = [&](Severity severity) {
        return static_cast<std::size_t>(
            std::count_if(findings.begin(), findings.end(), [&](const Finding& f) {
                return f.count > 0 && card_of(f.hazard).severity == severity;
            }));
    };
    return fmt::format("{}: {}, {}; {}; pixels of {}x{}", report.path,
                       counted(count(Severity::warning), "warning"),
                       counted(count(Severity::note), "note"), extent(report), report.width,
                       report.height);
}

Json place_json(const DoctorReport& report, const geom::HazardPlace& place) {
    Json json = Json::object();
    if (place.face) json["face"] = number_in_file(report, *place.face);
    if (place.other_face) json["other_face"] = number_in_file(report, *place.other_face);
    if (place.position) json["vertex"] = number_in_file(report, *place.position);
    if (place.at) json["at"] = {place.at->x, place.at->y, place.at->z};
    return json;
}

Json finding_json(const DoctorReport& report, const Finding& finding) {
    const geom::HazardCard& card = card_of(finding.hazard);
    Json json = {{"hazard", card.name},
                 {"severity", name_of(card.severity)},
                 {"count", finding.count},
                 {"searched", finding.searched},
                 {"worst", place_json(report, finding.worst)}};
    if (const auto line = line_of(report, finding)) json["worst"]["line"] = *line;
    if (!card.measure.empty() && finding.count > 0) json["measure"] = finding.measure;
    if (const auto pixels = pixels_of(report, finding.hazard); pixels && finding.count > 0) {
        const bool small = finding.hazard == Hazard::small_triangles;
        json[small ? "triangles" : "pixels"] = {
            {"here", pixels->here}, {"worst", pixels->worst}, {"worst_view", pixels->worst_view}};
    }
    json["text"] = sentence(report, finding);
    json["advice"] = card.advice;
    json["mended_by_fix"] = card.mended;
    return json;
}

// A path as a URI reference (RFC 3986).
std::string uri_of(std::string_view path) {
    constexpr std::string_view kPlain =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
    std::string uri = path.starts_with('/') ? "file://" : "";
    for (const char c : path)
        uri += kPlain.find(c) != std::string_view::npos
                   ? std::string(1, c)
                   : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    return uri;
}

} // namespace

std::vector<bool> textured(const std::vector<scene::Material>& materials) {
    std::vector<bool> with_map;
    for (const scene::Material& m : materials) {
        with_map.push_back(std::any_of(
            scene::kTextureMaps.begin(), scene::kTextureMaps.end(),
            [&](const scene::NamedMap& row) { return row.drawn && (m.*row.map).texture() >= 0; }));
    }
    return with_map;
}

std::vector<Finding> told_findings(const DoctorReport& report) {
    std::vector<Finding> findings = report.diagnosis.findings;
    if (const auto small = *pixels_of(report, Hazard::small_triangles); small.worst > 0)
        findings.push_back(
            {Hazard::small_triangles, static_cast<std::size_t>(small.worst), 0, {}, 1});
    std::stable_sort(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
        return card_of(a.hazard).severity < card_of(b.hazard).severity;
    });
    return findings;
}

bool has_warning(const DoctorReport& report) {
    return std::any_of(report.diagnosis.findings.begin(), report.diagnosis.findings.end(),
                       [](const Finding& finding) {
                           return finding.count > 0 &&
                                  card_of(finding.hazard).severity == Severity::warning;
                       });
}

std::vector<std::string> doctor_lines(const DoctorReport& report) {
    const std::vector<Finding> findings = told_findings(report);
    if (findings.empty())
        return {fmt::format("{}: nothing wrong; {}", report.path, extent(report))};
    std::vector<std::string> lines;
    for (const Finding& finding : findings) {
        const geom::HazardCard& card = card_of(finding.hazard);
        lines.push_back(fmt::format("{}: {}: {}", name_of(card.severity), card.name,
                                    sentence(report, finding)));
        if (finding.count > 0) lines.back() += fmt::format("; {}", card.advice);
    }
    lines.push_back(summary(report, findings));
    return lines;
}

std::string mended_line(const DoctorReport& report) {
    const geom::Mended& m = report.mended;
    std::vector<std::string> parts;
    const auto add = [&](std::size_t count, std::string_view one, std::string_view many) {
        if (count > 0) parts.push_back(fmt::format("{} {}", count, count == 1 ? one : many));
    };
    add(m.welded, "vertex welded", "vertices welded");
    add(m.split, "T-vertex made a corner", "T-vertices made corners");
    add(m.degenerate, "face without an area removed", "faces without an area removed");
    add(m.repeated, "repeated face removed", "repeated faces removed");
    add(m.turned, "face turned around", "faces turned around");
    add(m.unused, "unused vertex removed", "unused vertices removed");
    add(m.one_sided, "one-sided shell left as it is", "one-sided shells left as they are");
    if (parts.empty()) parts.emplace_back("nothing to mend, the same surface");
    return fmt::format("wrote {}: {}", report.fixed_path, fmt::join(parts, ", "));
}

std::string doctor_json(const DoctorReport& report) {
    Json hazards = Json::array();
    for (const Finding& finding : told_findings(report))
        hazards.push_back(finding_json(report, finding));
    Json json = {{"model", report.path},
                 {"faces", report.diagnosis.faces},
                 {"triangles", report.diagnosis.triangles},
                 {"width", report.width},
                 {"height", report.height},
                 {"quick", report.quick},
                 {"hazards", std::move(hazards)},
                 {"warnings", report.warnings}};
    if (!report.fixed_path.empty()) {
        const geom::Mended& m = report.mended;
        json["fixed"] = {{"path", report.fixed_path},  {"welded", m.welded},
                         {"split", m.split},           {"degenerate", m.degenerate},
                         {"repeated", m.repeated},     {"turned", m.turned},
                         {"unused", m.unused},         {"one_sided", m.one_sided},
                         {"not_kept", report.not_kept}};
    }
    return json_text(versioned(json));
}

std::string doctor_sarif(const DoctorReport& report) {
    Json rules = Json::array();
    for (const geom::HazardCard& card : geom::hazard_cards())
        rules.push_back({{"id", card.name},
                         {"shortDescription", {{"text", card.many}}},
                         {"help", {{"text", card.advice}}},
                         {"defaultConfiguration", {{"level", name_of(card.severity)}}}});
    Json results = Json::array();
    for (const Finding& finding : told_findings(report)) {
        const geom::HazardCard& card = card_of(finding.hazard);
        Json location = {
            {"physicalLocation", {{"artifactLocation", {{"uri", uri_of(report.path)}}}}}};
        if (const auto line = line_of(report, finding))
            location["physicalLocation"]["region"] = {{"startLine", *line}};
        results.push_back(
            {{"ruleId", card.name},
             {"ruleIndex", static_cast<int>(finding.hazard)},
             {"level", name_of(card.severity)},
             {"message", {{"text", fmt::format("{}; {}", sentence(report, finding), card.advice)}}},
             {"locations", Json::array({std::move(location)})}});
    }
    Json run = {
        {"tool",
         {{"driver", {{"name", "scanout"}, {"version", SCANOUT_VERSION}, {"rules", rules}}}}},
        {"columnKind", "unicodeCodePoints"},
        {"results", std::move(results)}};
    return json_text({{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                      {"version", "2.1.0"},
                      {"runs", Json::array({std::move(run)})}});
}

} // namespace scanout::app
