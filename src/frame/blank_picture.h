// A picture that shows nothing never comes without a line that says why: one that is its background
// everywhere.
#pragma once

#include "frame/renderer.h"

#include <cstdint>
#include <optional>
#include <string>

namespace scanout::frame {

// Why nothing of a model is drawn; the first that holds.
enum class Blank : std::uint8_t {
    depth_test, // it lets nothing through
    section,    // it cuts all of the model away
    outside,    // the model lies outside of the picture
    no_area,    // no triangle has one
    clear,      // all materials are
    culled,     // all faces are left out
    edge_on,    // seen from its edge
    cut_out,    // clear where the camera looks
    no_sample   // falls onto it
};
Blank why_nothing_is_drawn(const scene::Scene& scene, const scene::View& view,
                           const FramePlan& plan);

// The reason and what to do, of the picture that was rendered last; none where it shows something.
// up: how its camera takes the file's axes; a view by name is proposed in its terms.
std::optional<std::string> why_blank(const scene::Scene& scene, const scene::View& view,
                                     scene::UpAxis up, const FramePlan& plan,
                                     const FrameStats& stats, const image::Image& picture);

} // namespace scanout::frame
