#include "app/frontier/pictures.h"

#include "image/heat_map.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::app {
namespace {

// The part of the picture whose codes differ most, in squares.
image::Rect worst_part(const image::Image& a, const image::Image& b) {
    constexpr int kStep = 16;
    const int width = std::min(kCrop, a.width()), height = std::min(kCrop, a.height());
    image::Rect worst{0, 0, width, height};
    std::int64_t most = -1;
    for (int y = 0; y + height <= a.height(); y += kStep)
        for (int x = 0; x + width <= a.width(); x += kStep) {
            std::int64_t sum = 0;
            for (int v = y; v < y + height; ++v)
                for (int u = x; u < x + width; ++u) {
                    const image::Rgba8 &p = a.at(u, v), &q = b.at(u, v);
                    const int r = p.r - q.r, g = p.g - q.g, blue = p.b - q.b;
                    sum += r * r + g * g + blue * blue;
                }
            if (sum <= most) continue;
            most = sum;
            worst = {x, y, x + width, y + height};
        }
    return worst;
}

image::Image part(const image::Image& picture, const image::Rect& area) {
    image::Image out(area.width(), area.height());
    for (int y = 0; y < area.height(); ++y)
        for (int x = 0; x < area.width(); ++x)
            out.at(x, y) = picture.at(area.x0 + x, area.y0 + y);
    return out;
}

} // namespace

std::vector<ShownPoint> shown_points(const FrontierReport& report) {
    if (!report.has_frontier()) return {{"As asked for", 0}};
    const measure::Frontier& found = report.found;
    std::vector<ShownPoint> each;
    for (const ShownPoint& shown :
         {ShownPoint{"The quickest", found.frontier.front().point}, ShownPoint{"As asked for", 0},
          ShownPoint{"The knee", *found.knee()},
          ShownPoint{"The most accurate", found.frontier.back().point}})
        if (std::none_of(each.begin(), each.end(),
                         [&](const ShownPoint& other) { return other.point == shown.point; }))
            each.push_back(shown);
    return each;
}

std::string caption_of(const FrontierReport& report, const ShownPoint& shown) {
    std::string caption = fmt::format("{} ({}): {:.3f} codes RMSE", shown.what,
                                      report.name_of(shown.point), report.found.error(shown.point));
    if (report.timed()) caption += fmt::format(", {:.2f} ms", report.found.wall_ms(shown.point));
    return caption;
}

PointPictures pictures_of(const FrontierReport& report, std::size_t point) {
    PointPictures pictures;
    pictures.drawn = report.found.points->drawn(point);
    pictures.heat = image::heat_map(report.reference, pictures.drawn);
    const image::Rect worst = worst_part(report.reference, pictures.drawn);
    pictures.crop = part(pictures.drawn, worst);
    pictures.right = part(report.reference, worst);
    return pictures;
}

} // namespace scanout::app
