#include "app/picture/made_picture.h"

#include "app/files.h"
#include "app/message.h"
#include "app/picture/picture.h"
#include "base/available_memory.h"

#include <fmt/ranges.h>

namespace scanout::app {

Result<void> check_made(const Settings& settings) {
    if (settings.output.empty())
        return fail(Exit::usage, "where should the picture go? say -o FILE.png");
    TRY_VOID(picture_format(settings.output, settings.picture_format));
    return check_outputs(settings.arguments, {settings.output});
}

Result<void> check_one_picture(const Settings& settings, std::string_view command,
                               std::string_view example) {
    if (settings.arguments.size() == 1) return check_readable(settings.arguments.front());
    if (settings.arguments.empty())
        return fail(Exit::usage, "name a picture, as in `scanout {}`", example);
    return fail(Exit::usage, "{} takes one picture, not {}; run it once for each", command,
                fmt::join(settings.arguments, " and "));
}

Result<void> check_memory(const std::string& what, std::int64_t bytes) {
    const auto needed = static_cast<std::uint64_t>(bytes);
    const std::uint64_t available = available_bytes();
    if (needed <= available) return {};
    constexpr std::uint64_t kMegabyte = 1'000'000;
    return fail(Exit::unreadable,
                "{} takes {} MB of memory, and {} MB are available: close other programs, or take "
                "a smaller picture",
                what, needed / kMegabyte, available / kMegabyte);
}

Result<void> write_made(const Settings& settings, const image::Image& picture) {
    TRY(const PictureFormat format, picture_format(settings.output, settings.picture_format));
    TRY(const image::Bytes bytes, encode(picture, format, std::nullopt));
    TRY_VOID(write_picture(settings.output, bytes));
    if (settings.verbose) say(fmt::format("wrote {} ({} bytes)", settings.output, bytes.size()));
    return {};
}

} // namespace scanout::app
