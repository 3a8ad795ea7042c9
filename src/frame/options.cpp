#include "frame/options.h"

#include <utility>

namespace scanout::frame {

std::string* asked(FrameOptions& o, std::string_view axis) {
    const std::pair<std::string_view, std::string*> axes[] = {{"texture", &o.texture},
                                                              {"wrap", &o.wrap},
                                                              {"reflection", &o.reflection},
                                                              {"shading", &o.shading},
                                                              {"transparency", &o.transparency}};
    for (const auto& [name, technique] : axes)
        if (name == axis) return technique;
    return nullptr;
}

} // namespace scanout::frame
