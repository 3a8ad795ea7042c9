// What `scanout doctor` says: one line a hazard, JSON, and SARIF for CI.
#pragma once

#include "geom/diagnose/diagnosis.h"
#include "geom/mend.h"
#include "io/formats.h"
#include "measure/hazard_pixels.h"
#include "scene/material.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace scanout::app {

struct DoctorReport {
    std::string path;
    io::ModelFormat format{};
    int width = 0, height = 0;
    bool quick = false;        // seams, overlaps and intersections were not searched
    double radii_per_unit = 1; // of the file
    geom::Diagnosis diagnosis;
    measure::HazardPixels pixels;
    std::vector<std::string> warnings; // of the reader
    std::string fixed_path;            // of --fix; empty: nothing was written
    geom::Mended mended;
    std::vector<std::string> not_kept;                     // by --fix
    std::vector<std::uint32_t> face_lines, position_lines; // of io::ModelSource
};

// By material: whether it has a map, so that its faces need texture coordinates.
std::vector<bool> textured(const std::vector<scene::Material>& materials);

// The findings, small triangles of the views with them, in the order in which they are told:
// warnings first.
std::vector<geom::Finding> told_findings(const DoctorReport& report);
bool has_warning(const DoctorReport& report);

std::vector<std::string> doctor_lines(const DoctorReport& report);
std::string mended_line(const DoctorReport& report); // what --fix wrote
std::string doctor_json(const DoctorReport& report);
std::string doctor_sarif(const DoctorReport& report); // SARIF 2.1.0 (OASIS 2020)

} // namespace scanout::app
