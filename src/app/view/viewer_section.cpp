// The section plane by keys: J goes through the axes, and from the third to none.
#include "app/view/viewer.h"

namespace scanout::app {
namespace {

constexpr int kSlideLevels = 400; // from one side of the model's box to the other

} // namespace

void Viewer::next_section() {
    std::optional<scene::SectionSpec>& section = state_.look.section;
    using enum scene::SectionAxis;
    if (!section) {
        section = scene::SectionSpec{.axis = x};
    } else if (section->axis == x || section->axis == y) {
        const auto next = section->axis == x ? y : z;
        section = scene::SectionSpec{.axis = next, .low = section->low};
    } else {
        section.reset();
    }
}

// The side that was cut away is seen, and the other one goes.
void Viewer::flip_section() {
    std::optional<scene::SectionSpec>& section = state_.look.section;
    if (!section) {
        answer_ = "no section to turn: J makes one";
        return;
    }
    section->low = section->axis != scene::SectionAxis::oblique && !section->low;
    section->normal = DVec3(0) - section->normal;
    section->offset = 0 - section->offset;
}

void Viewer::slide_section(int levels, const geom::Mesh* mesh) {
    std::optional<scene::SectionSpec>& section = state_.look.section;
    if (!section)
        answer_ = "no section to slide: J makes one";
    else if (mesh != nullptr)
        section = scene::slid(*section, static_cast<double>(levels) / kSlideLevels, *mesh);
}

} // namespace scanout::app
