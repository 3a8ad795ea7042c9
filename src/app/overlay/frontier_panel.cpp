#include "app/overlay/frontier_panel.h"

#include "app/frontier/chart_axes.h"
#include "app/overlay/text.h"
#include "app/overlay/text_block.h"
#include "math/transcendental.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::app {
namespace {

constexpr image::Rgba8 kAxisLine{120, 130, 145, 255}, kHere{255, 196, 64, 255};
constexpr int kPlotWidth = 300, kPlotHeight = 100; // font pixels

void dot(image::Image& picture, int x, int y, int radius, image::Rgba8 colour) {
    for (int v = std::max(y - radius, 0); v <= std::min(y + radius, picture.height() - 1); ++v)
        for (int u = std::max(x - radius, 0); u <= std::min(x + radius, picture.width() - 1); ++u)
            if ((u - x) * (u - x) + (v - y) * (v - y) <= radius * radius + radius)
                picture.at(u, v) = colour;
}

// Where a value lies between the least and the greatest, 0 to 1, by logarithms.
class Axis {
public:
    void add(double value) {
        low_ = std::min(low_, value);
        high_ = std::max(high_, value);
    }
    double place(double value) const {
        return high_ > low_ ? log2(value / low_) / log2(high_ / low_) : 0.5;
    }

private:
    double low_ = 1e300, high_ = 1e-300;
};

struct Plot {
    int left, top, width, height;
    Axis time, error;
    struct Place {
        int x, y;
    };
    Place place(const FrontierPanel::Point& p) const {
        return {left + static_cast<int>(time.place(p.ms) * width),
                top + static_cast<int>((1 - error.place(std::max(p.error, kLeastError))) * height)};
    }
};

// A step function: between two points nothing better is known than the left one.
void draw_steps(image::Image& picture, const Plot& plot, const FrontierPanel& panel, int scale) {
    for (std::size_t i = 0; i + 1 < panel.points.size(); ++i) {
        const auto [x0, y0] = plot.place(panel.points[i]);
        const auto [x1, y1] = plot.place(panel.points[i + 1]);
        for (int x = x0; x <= x1; ++x)
            dot(picture, x, y0, scale / 2, kAxisLine);
        for (int y = std::min(y0, y1); y <= std::max(y0, y1); ++y)
            dot(picture, x1, y, scale / 2, kAxisLine);
    }
}

} // namespace

int frontier_panel_width(const FrontierPanel& panel, int scale) {
    const int text = block_of(panel.lines, scale).width;
    const bool plots = panel.points.size() > 1;
    return plots ? std::max(text, (kPlotWidth + 2 * kBlockMargin) * scale) : text;
}

void draw_frontier_panel(image::Image& picture, const FrontierPanel& panel, int top, int scale) {
    const int margin = kBlockMargin * scale, line = kGlyphHeight * scale;
    const TextBlock text = block_of(panel.lines, scale);
    const bool plots = panel.points.size() > 1;
    const int width = frontier_panel_width(panel, scale);
    const int left = picture.width() - width;
    const int height = text.height + (plots ? kPlotHeight * scale + 2 * margin + line : 0);
    draw_panel(picture, {left, top, left + width, top + height}, kBlockPanel);
    draw_lines(picture, panel.lines, left + margin, top + margin, scale);
    if (!plots) return;
    const int room = 2 * margin; // for dots at the ends
    Plot plot{left + room, top + text.height + margin, width - 2 * room, kPlotHeight * scale, {},
              {}};
    for (const FrontierPanel::Point& p : panel.points) {
        plot.time.add(p.ms);
        plot.error.add(std::max(p.error, kLeastError));
    }
    draw_steps(picture, plot, panel, scale);
    for (const FrontierPanel::Point& p : panel.points) {
        const auto [x, y] = plot.place(p);
        dot(picture, x, y, 2 * scale, kBlockText);
    }
    const auto [x, y] = plot.place(panel.points[panel.at]);
    dot(picture, x, y, 4 * scale, kHere);
    // The ends of both axes: the quickest point errs most.
    const FrontierPanel::Point &first = panel.points.front(), &last = panel.points.back();
    const std::string from = fmt::format("{:.2g} ms {:.2g} codes", first.ms, first.error),
                      to = fmt::format("{:.2g} ms {:.2g} codes", last.ms, last.error);
    const int y_text = top + height - margin - line;
    draw_text(picture, left + margin, y_text, from, kBlockText, scale);
    draw_text(picture, left + width - margin - text_width(to, scale), y_text, to, kBlockText,
              scale);
}

} // namespace scanout::app
