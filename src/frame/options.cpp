#include "frame/options.h"

#include <utility>

namespace scanout::frame {

bool ask(FrameOptions& o, std::string_view axis, std::string_view technique) {
    const std::pair<std::string_view, std::string*> axes[] = {{"interpolate", &o.interpolate},
                                                              {"texture", &o.texture},
                                                              {"wrap", &o.wrap},
                                                              {"source", &o.source},
                                                              {"mapping", &o.mapping},
                                                              {"reflection", &o.reflection},
                                                              {"shading", &o.shading},
                                                              {"shadow", &o.shadow},
                                                              {"transparency", &o.transparency},
                                                              {"blend", &o.blend},
                                                              {"stencil", &o.stencil},
                                                              {"depth", &o.depth},
                                                              {"depth_test", &o.depth_test},
                                                              {"aa", &o.aa},
                                                              {"tone", &o.tone},
                                                              {"blend_space", &o.blend_space},
                                                              {"encode", &o.encode},
                                                              {"dither", &o.dither},
                                                              {"convolution", &o.convolution}};
    for (const auto& [name, asked] : axes) {
        if (name != axis) continue;
        *asked = technique;
        if (axis == "aa") o.samples = 1; // another way to ask for the same
        return true;
    }
    return false;
}

} // namespace scanout::frame
