// The searches of a diagnosis, one for each family of hazards.
#pragma once

#include "geom/diagnose/diagnose.h"
#include "geom/diagnose/diagnosis.h"
#include "geom/diagnose/surface.h"

#include <atomic>
#include <mutex>
#include <vector>

namespace scanout::geom {

// Where the searches put what they find. May be called from several threads at once.
class Findings {
public:
    explicit Findings(Diagnosis& out) : out_(out) {}

    // `measure`: from the tally's badness, where that is not it.
    void add(Hazard hazard, const Tally& tally, double measure, double searched = 1);
    void add(Hazard hazard, const Tally& tally) { add(hazard, tally, tally.badness()); }
    void mark(std::uint32_t face, Hazard hazard) {
        std::atomic_ref(out_.marks[face]).fetch_or(mask_of(hazard), std::memory_order_relaxed);
    }

private:
    Diagnosis& out_;
    std::mutex mutex_;
};

DVec3 middle_of(const Surface& surface, const Surface::Triangle& triangle); // file units
DVec3 file_position(const Surface& surface, std::uint32_t place);
HazardPlace at_face(const Surface& surface, std::uint32_t face);
HazardPlace at_edge(const Surface& surface, const Surface::EdgeUse& use);

void examine_shapes(const Surface& surface, Findings& findings);
void examine_edges(const Surface& surface, Findings& findings);
void examine_duplicates(const Surface& surface, Findings& findings);
void examine_normals(const Surface& surface, Findings& findings);
void examine_uvs(const Surface& surface, const DiagnoseOptions& how, Findings& findings);
void examine_numbers(const Surface& surface, Findings& findings);
void examine_seams(const Surface& surface, const DiagnoseOptions& how, Findings& findings);
// False where progress ended it.
bool examine_pairs(const Surface& surface, const DiagnoseOptions& how, Findings& findings);

} // namespace scanout::geom
