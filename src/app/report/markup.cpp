#include "app/report/markup.h"

#include "app/message.h"

namespace scanout::app {

std::string as_markup(std::string_view text) {
    std::string out;
    for (const char c : escaped(text)) {
        switch (c) {
        case '&':
            out += "&amp;";
            break;
        case '<':
            out += "&lt;";
            break;
        case '>':
            out += "&gt;";
            break;
        case '"':
            out += "&quot;";
            break;
        default:
            out += c;
        }
    }
    return out;
}

} // namespace scanout::app
