#include "io/text_parts.h"

#include "io/cursor.h"

#include <algorithm>

namespace scanout::io {
namespace {

constexpr std::size_t kPartsOfAThread = 4; // so that all stay busy until nearly the end
constexpr std::size_t kLongestPause = 4096;

// Does the line that ends before `end` continue behind it? It may be part of a comment, which does
// not continue: then a possible cut is not used.
bool is_continued(std::string_view text, std::size_t end) {
    while (end > 0 && Cursor::is_blank(text[end - 1]))
        --end;
    return end > 0 && text[end - 1] == '\\';
}

} // namespace

std::vector<std::string_view> TextParts::next(std::string_view text, MayBegin may_begin) {
    std::vector<std::string_view> parts;
    if (how_.jobs == nullptr || how_.jobs->threads() == 1) return parts;
    if (pauses_left_ > 0) {
        --pauses_left_;
        return parts;
    }
    const std::size_t most = kPartsOfAThread * static_cast<std::size_t>(how_.jobs->threads());
    while (parts.size() < most && !text.empty()) {
        const std::size_t end = cut(text, how_.part_bytes, may_begin);
        if (end == 0) break;
        parts.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    if (parts.size() < 2) parts.clear();
    return parts;
}

// The end of a part that is about `from` long; 0 when there is none nearby.
std::size_t TextParts::cut(std::string_view text, std::size_t from, MayBegin may_begin) const {
    if (text.size() <= from) return text.size();
    const std::size_t last = std::min(text.size() - 1, from + how_.part_bytes);
    for (std::size_t i = from; i < last; ++i) {
        const bool ends = text[i] == '\n' || (text[i] == '\r' && text[i + 1] != '\n');
        if (!ends) continue;
        const std::size_t line_end = text[i] == '\n' && i > 0 && text[i - 1] == '\r' ? i - 1 : i;
        if (!is_continued(text, line_end) && may_begin(text.substr(i + 1))) return i + 1;
    }
    return 0;
}

void TextParts::read_again(std::size_t parts, std::size_t of) {
    if (how_.read_again != nullptr) *how_.read_again += parts;
    pause_ = 2 * parts > of ? std::clamp<std::size_t>(2 * pause_, of, kLongestPause) : 0;
    pauses_left_ = pause_;
}

} // namespace scanout::io
