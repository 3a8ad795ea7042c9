#include "textbook/line.h"

namespace scanout::textbook {

LineMethod line_method(Line line) {
#define TEXTBOOK_FUNCTION(name, blurb) line_##name,
    static constexpr std::array kMethods = {TEXTBOOK_LINE(TEXTBOOK_FUNCTION)};
#undef TEXTBOOK_FUNCTION
    return kMethods[static_cast<std::size_t>(line)];
}

} // namespace scanout::textbook
