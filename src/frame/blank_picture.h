// A picture that shows nothing never comes without a line that says why: one that is its background
// everywhere.
#pragma once

#include "frame/renderer.h"

#include <optional>
#include <string>

namespace scanout::frame {

// The reason and what to do, of the picture that was rendered last; none where it shows something.
// up: how its camera takes the file's axes; a view by name is proposed in its terms.
std::optional<std::string> why_blank(const scene::Scene& scene, const scene::View& view,
                                     scene::UpAxis up, const FramePlan& plan,
                                     const FrameStats& stats, const image::Image& picture);

} // namespace scanout::frame
