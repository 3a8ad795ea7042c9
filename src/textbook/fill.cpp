#include "textbook/fill.h"

namespace scanout::textbook {

FillMethod fill_method(Fill fill) {
#define TEXTBOOK_FUNCTION(name, blurb) fill_##name,
    static constexpr std::array kMethods = {TEXTBOOK_FILL(TEXTBOOK_FUNCTION)};
#undef TEXTBOOK_FUNCTION
    return kMethods[static_cast<std::size_t>(fill)];
}

} // namespace scanout::textbook
