// The chart's layout, drawn once as SVG and once as pixels.
#include "app/frontier/chart_axes.h"
#include "app/overlay/text.h"
#include "app/overlay/text_block.h"
#include "app/report/markup.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace scanout::app {
namespace {

struct Place {
    double x, y;
};
enum class Anchor : std::uint8_t { start, middle, end };

constexpr image::Rgba8 kBlack{0, 0, 0, 255}, kGrey{0x88, 0x88, 0x88, 255},
    kPale{0xcc, 0xcc, 0xcc, 255}, kNoise{0xe4, 0xe4, 0xe4, 255}, kDark{0x33, 0x33, 0x33, 255},
    kCurve{0xb5, 0x36, 0x7a, 255};

constexpr double kPixels = 1.5; // a unit of the layout

// What a chart is made of: upright rectangles, discs, text. Units are those of the layout, y down.
class Canvas {
public:
    virtual ~Canvas() = default;
    virtual void rectangle(const Place& from, const Place& to, image::Rgba8 colour) = 0;
    // note: shown where a pointer rests on it, if that can be.
    virtual void disc(const Place& middle, double radius, image::Rgba8 colour,
                      const std::string& note) = 0;
    virtual void text(const Place& at, const std::string& line, Anchor anchor,
                      image::Rgba8 colour) = 0;
};

class SvgCanvas final : public Canvas {
public:
    SvgCanvas(double width, double height)
        : out_(fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:g} {:g}\" "
                           "font-family=\"sans-serif\" font-size=\"12\">\n",
                           width, height)) {}
    void rectangle(const Place& from, const Place& to, image::Rgba8 colour) override {
        out_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
                            "fill=\"{}\"/>\n",
                            from.x, from.y, to.x - from.x, to.y - from.y, name(colour));
    }
    void disc(const Place& middle, double radius, image::Rgba8 colour,
              const std::string& note) override {
        out_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:g}\" fill=\"{}\"><title>{}"
                            "</title></circle>\n",
                            middle.x, middle.y, radius, name(colour), as_markup(note));
    }
    void text(const Place& at, const std::string& line, Anchor anchor,
              image::Rgba8 colour) override {
        constexpr std::string_view kAnchors[] = {"start", "middle", "end"};
        out_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" fill=\"{}\">{}"
                            "</text>\n",
                            at.x, at.y, kAnchors[static_cast<std::size_t>(anchor)], name(colour),
                            as_markup(line));
    }
    std::string file() const { return out_ + "</svg>\n"; }

private:
    static std::string name(image::Rgba8 c) {
        return fmt::format("#{:02x}{:02x}{:02x}", c.r, c.g, c.b);
    }
    std::string out_;
};

class PictureCanvas final : public Canvas {
public:
    PictureCanvas(double width, double height) : picture_(pixel(width), pixel(height)) {}
    void rectangle(const Place& from, const Place& to, image::Rgba8 colour) override {
        const int x0 = pixel(from.x), y0 = pixel(from.y);
        draw_panel(picture_, {x0, y0, std::max(pixel(to.x), x0 + 1), std::max(pixel(to.y), y0 + 1)},
                   colour);
    }
    void disc(const Place& middle, double radius, image::Rgba8 colour,
              const std::string& /*note*/) override {
        const int rows = pixel(radius);
        for (int y = -rows; y <= rows; ++y) {
            const int half = static_cast<int>(std::sqrt(rows * rows - y * y));
            const int x = pixel(middle.x), row = pixel(middle.y) + y;
            draw_panel(picture_, {x - half, row, x + half + 1, row + 1}, colour);
        }
    }
    void text(const Place& at, const std::string& line, Anchor anchor,
              image::Rgba8 colour) override {
        const int width = text_width(line);
        const int left = anchor == Anchor::start ? 0 : anchor == Anchor::middle ? width / 2 : width;
        constexpr int kAboveBase = 12; // pixels of a letter
        draw_text(picture_, pixel(at.x) - left, pixel(at.y) - kAboveBase, line, colour);
    }
    image::Image picture() && { return std::move(picture_); }

private:
    static int pixel(double units) { return static_cast<int>(std::lround(units * kPixels)); }
    image::Image picture_;
};

constexpr double kLeft = 56, kTop = 56, kAcross = 760, kDown = 380, kTextLine = 16;
constexpr double kWide = kLeft + kAcross + 24, kEdge = 8, kTextLeft = 32;

struct LegendLine {
    std::string number; // empty where the line before goes on
    std::string text;
};
// A line for each point of the frontier, or more where its name is long.
std::vector<LegendLine> legend_lines(const Chart& chart) {
    constexpr auto kLetters =
        static_cast<std::size_t>((kWide - kTextLeft - kEdge) * kPixels / kGlyphWidth);
    std::vector<LegendLine> lines;
    for (const ChartPoint& p : chart.points) {
        if (p.number == 0) continue;
        const std::string text =
            fmt::format("{:.2f} ms, {:.3f} codes: {}", p.time, p.error, p.name);
        std::string number = fmt::format("{:2}", p.number);
        for (std::string& line : broken_into_lines(text, kLetters))
            lines.push_back({std::exchange(number, ""), std::move(line)});
    }
    return lines;
}

double height_of(const Chart& chart) {
    return kTop + kDown + 68 + kTextLine * static_cast<double>(legend_lines(chart).size());
}

class Layout {
public:
    Layout(const Chart& chart, Canvas& canvas)
        : chart_(chart), axes_(axes_of(chart)), canvas_(canvas) {}

    void draw() {
        canvas_.rectangle({0, 0}, {kWide, height_of(chart_)}, {255, 255, 255, 255});
        canvas_.text({kLeft, 20}, chart_.title, Anchor::start, kBlack);
        canvas_.text({kEdge, kTop - 14}, "error, codes RMSE", Anchor::start, kBlack);
        noise();
        grid();
        steps();
        for (auto p = chart_.points.rbegin(); p != chart_.points.rend(); ++p) // the frontier last
            point(*p);
        for (const ChartPoint& p : chart_.points) // over all points
            if (p.number > 0) number(p);
        legend();
    }

private:
    Place place(double time, double error) const {
        return {kLeft + kAcross * axes_.time.place(time),
                kTop + kDown * (1 - axes_.error.place(error))};
    }
    // A line along an axis.
    void line(const Place& a, const Place& b, image::Rgba8 colour) {
        constexpr double kHalf = 0.5;
        canvas_.rectangle({std::min(a.x, b.x) - kHalf, std::min(a.y, b.y) - kHalf},
                          {std::max(a.x, b.x) + kHalf, std::max(a.y, b.y) + kHalf}, colour);
    }
    void noise() {
        const double top = place(1, chart_.noise).y;
        canvas_.rectangle({kLeft, top}, {kLeft + kAcross, kTop + kDown}, kNoise);
        canvas_.text({kLeft + kAcross - 4, kTop + kDown - 6}, "noise of the reference", Anchor::end,
                     kGrey);
    }
    void grid() {
        for (const double t : axes_.time.ticks()) {
            const double x = place(t, 1).x;
            line({x, kTop}, {x, kTop + kDown}, kPale);
            canvas_.text({x, kTop + kDown + 16}, fmt::format("{:g}", t), Anchor::middle, kDark);
        }
        for (const double e : axes_.error.ticks()) {
            const double y = place(1, e).y;
            line({kLeft, y}, {kLeft + kAcross, y}, kPale);
            canvas_.text({kLeft - 6, y + 4}, fmt::format("{:g}", e), Anchor::end, kDark);
        }
        canvas_.text({kLeft + kAcross, kTop + kDown + 34}, "CPU ms a frame", Anchor::end, kBlack);
    }
    // Between two points nothing better is known than the first.
    void steps() {
        const ChartPoint* last = nullptr;
        for (const ChartPoint& p : chart_.points) {
            if (p.number == 0) continue;
            if (last != nullptr) {
                const Place from = place(last->time, last->error), to = place(p.time, p.error);
                line(from, {to.x, from.y}, kCurve);
                line({to.x, from.y}, to, kCurve);
            }
            last = &p;
        }
    }
    void point(const ChartPoint& p) {
        const image::Rgba8 colour = p.number > 0 ? kCurve : kGrey;
        const Place at = place(p.time, p.error);
        const double radius = p.number > 0 ? 4 : 3;
        line(place(p.time_low, p.error), place(p.time_high, p.error), colour);
        line(place(p.time, p.error_low), place(p.time, p.error_high), colour);
        const std::string note =
            fmt::format("{}: {:.3f} codes, {:.2f} ms", p.name, p.error, p.time);
        if (p.asked) canvas_.disc(at, radius + 2, kBlack, note);
        canvas_.disc(at, radius, colour, note);
    }
    void number(const ChartPoint& p) {
        const Place at = place(p.time, p.error);
        canvas_.text({at.x + 6, at.y - 6}, fmt::format("{}", p.number), Anchor::start, kDark);
    }
    void legend() {
        double y = kTop + kDown + 56;
        canvas_.text({kEdge, y},
                     "The frontier (black ring: as asked for; bars: 95 % interval of the time, "
                     "noise of the error)",
                     Anchor::start, kBlack);
        for (const LegendLine& line : legend_lines(chart_)) {
            y += kTextLine;
            if (!line.number.empty()) canvas_.text({kEdge, y}, line.number, Anchor::start, kDark);
            canvas_.text({kTextLeft, y}, line.text, Anchor::start, kDark);
        }
    }

    const Chart& chart_;
    ChartAxes axes_;
    Canvas& canvas_;
};

} // namespace

std::string chart_svg(const Chart& chart) {
    SvgCanvas canvas(kWide, height_of(chart));
    Layout(chart, canvas).draw();
    return canvas.file();
}

image::Image chart_picture(const Chart& chart) {
    PictureCanvas canvas(kWide, height_of(chart));
    Layout(chart, canvas).draw();
    return std::move(canvas).picture();
}

} // namespace scanout::app
