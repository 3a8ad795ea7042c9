// The section of a scene: its mesh without what lies in front of a plane (geom/section.h), with
// caps in a material of their own.
#pragma once

#include "base/jobs.h"
#include "geom/mesh.h"
#include "geom/section.h"
#include "scene/scene.h"

#include <optional>
#include <string>

namespace scanout::scene {

// The file's axis that a plane is square to; oblique: a normal and an offset.
enum class SectionAxis : std::uint8_t { x, y, z, oblique };

// A plane as the user says it: square to an axis, at a share of the model's box from its low side;
// or the points p of the file with dot(normal, p) = offset.
struct SectionSpec {
    SectionAxis axis = SectionAxis::oblique;
    bool low = false;   // of an axis: its low side goes, not the high one
    double share = 0.5; // of an axis
    DVec3 normal{0};    // oblique: towards what goes
    double offset = 0;
    friend bool operator==(const SectionSpec&, const SectionSpec&) = default;
};

std::string to_string(const SectionSpec& spec); // "x:0.5", "-z:0.25", "1,1,0,2"

// In the mesh's space. A plane square to an axis has a float's offset, as vertices have: vertices
// of the file that lie on it do.
geom::SectionPlane section_plane(const SectionSpec& spec, const geom::Mesh& mesh);

// The plane moved towards its high side, or an oblique one to its front, by a share of the model's
// box, which it does not leave.
SectionSpec slid(const SectionSpec& spec, double share, const geom::Mesh& mesh);

// Cuts the mesh of the scene, whole again before if an earlier cut kept that in `whole`; without a
// spec the mesh is whole. `whole` is empty where the scene has it.
void put_section(Jobs& jobs, const std::optional<SectionSpec>& spec, Scene& scene,
                 std::optional<geom::Mesh>& whole);

// What a section came to that the user should know: it changes nothing, leaves nothing, or leaves
// some of the cut open. Empty: all is as it should be.
std::string remark(const SceneSection& section);

} // namespace scanout::scene
