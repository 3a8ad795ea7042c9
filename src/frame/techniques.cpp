#include "frame/techniques.h"

#include "shade/stage.h"
#include "shade/transparency.h"

#include <fmt/format.h>

namespace scanout::frame {

const std::vector<const Technique*>& techniques() {
    static const std::vector<const Technique*> all = [] {
        std::vector<const Technique*> found;
        for (const shade::Filter* filter : shade::filters())
            found.push_back(&filter->card);
        for (const shade::Wrapping* wrapping : shade::wrappings())
            found.push_back(&wrapping->card);
        for (const shade::Stage* stage : shade::stages())
            found.push_back(&stage->card);
        for (const shade::Transparency* transparency : shade::transparencies())
            found.push_back(&transparency->card);
        return found;
    }();
    return all;
}

std::string names_of(std::string_view axis) {
    std::string names;
    for (const Technique* technique : techniques())
        if (technique->axis == axis) names += fmt::format(" {}", technique->name);
    return names;
}

} // namespace scanout::frame
