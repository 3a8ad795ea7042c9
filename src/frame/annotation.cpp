#include "frame/annotation.h"

#include <algorithm>

namespace scanout::frame {

std::string to_string(Annotations annotations) {
    std::string text;
    for (std::size_t i = 0; i < kAnnotationNames.size(); ++i) {
        if (!annotations.has(static_cast<Annotation>(i))) continue;
        if (!text.empty()) text += ',';
        text += kAnnotationNames[i];
    }
    return text.empty() ? "none" : text;
}

std::optional<Annotation> annotation_named(std::string_view name) {
    const auto* const found = std::find(kAnnotationNames.begin(), kAnnotationNames.end(), name);
    if (found == kAnnotationNames.end()) return std::nullopt;
    return static_cast<Annotation>(found - kAnnotationNames.begin());
}

} // namespace scanout::frame
