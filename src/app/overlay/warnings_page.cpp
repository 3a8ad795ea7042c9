#include "app/overlay/warnings_page.h"

#include "app/overlay/text_block.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::app {

ScreenPage warnings_page(const std::vector<std::string>& warnings, std::size_t letters,
                         std::size_t lines, std::size_t page) {
    constexpr std::size_t kIndent = 2;
    if (warnings.empty()) return {{"the file has no warnings"}, 1};
    std::vector<std::string> all;
    for (const std::string& warning : warnings) {
        std::string_view start = "- ";
        for (const std::string& part :
             broken_into_lines(warning, letters > kIndent ? letters - kIndent : 1)) {
            all.push_back(std::string(start) + part);
            start = "  ";
        }
    }
    const std::string heading =
        fmt::format("{} warning{} of the file", warnings.size(), warnings.size() == 1 ? "" : "s");
    const std::size_t capacity = std::max<std::size_t>(lines, 3) - 2; // with heading and last line
    const std::size_t pages = (all.size() + capacity - 1) / capacity;
    const std::size_t shown = std::clamp<std::size_t>(page, 1, pages);
    ScreenPage result{{heading}, pages};
    const auto first = all.begin() + static_cast<std::ptrdiff_t>((shown - 1) * capacity);
    result.lines.insert(
        result.lines.end(), first,
        first + std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(capacity), all.end() - first));
    result.lines.push_back(page_footer(shown, pages));
    return result;
}

} // namespace scanout::app
