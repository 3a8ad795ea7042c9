#include "app/frontier_chart.h"
#include "app/frontier_files.h"
#include "app/markup.h"
#include "image/codec.h"
#include "image/heat_map.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

namespace scanout::app {
namespace {

constexpr std::string_view kHead =
    "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<title>{0}</title>\n<style>\n"
    "body{{font:16px/1.5 sans-serif;max-width:60rem;margin:0 auto;padding:1rem;color:#111;"
    "background:#fff}}\n"
    "h1{{font-size:1.4rem}}h2{{font-size:1.1rem;margin:1.5rem 0 .3rem}}\n"
    ".wide{{overflow-x:auto}}table{{border-collapse:collapse;font-size:.85rem}}\n"
    "td,th{{padding:.15rem .6rem;border-bottom:1px solid #ddd;text-align:right;"
    "white-space:nowrap}}\n"
    "td:first-child,th:first-child,td:last-child,th:last-child{{text-align:left}}\n"
    "svg{{width:100%;height:auto}}figure{{margin:1rem 0;break-inside:avoid}}\n"
    ".row{{display:flex;flex-wrap:wrap;gap:.5rem}}.row img{{width:19rem;max-width:100%;"
    "height:auto}}\n"
    "img.crop{{image-rendering:pixelated;width:9.25rem!important}}\n"
    "figcaption,small{{font-size:.85rem;color:#444}}\n"
    "@media print{{body{{max-width:none;font-size:11pt}}.wide{{overflow:visible}}}}\n"
    "</style></head><body>\n<h1>{0}</h1>\n";

constexpr int kCrop = 64; // pixels a side

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

Result<std::string> embedded(const image::Image& picture, std::string_view what,
                             std::string_view style = "") {
    TRY(const image::Bytes png, image::encode_png(picture));
    return fmt::format("<img{} alt=\"{}\" title=\"{}\" src=\"data:image/png;base64,{}\">", style,
                       as_markup(what), as_markup(what), base64(png));
}

std::string table_html(const ReportTable& table) {
    std::string html =
        fmt::format("<h2>{}</h2>\n<div class=\"wide\"><table>\n", as_markup(table.title));
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        html += "<tr>";
        for (const std::string& cell : table.rows[i])
            html += i == 0 ? fmt::format("<th>{}</th>", as_markup(cell))
                           : fmt::format("<td>{}</td>", as_markup(cell));
        html += "</tr>\n";
    }
    html += "</table></div>\n";
    for (const std::string& note : table.notes)
        html += fmt::format("<p><small>{}</small></p>\n", as_markup(note));
    return html;
}

// What is shown: the quickest, as asked for, the knee, the most accurate.
std::vector<std::pair<std::string, std::size_t>> shown(const FrontierReport& report) {
    if (!report.timed()) return {{"As asked for", 0}};
    const measure::Frontier& found = report.found;
    std::vector<std::pair<std::string, std::size_t>> all = {
        {"The quickest", found.frontier.front().point},
        {"As asked for", 0},
        {"The knee", *found.knee()},
        {"The most accurate", found.frontier.back().point}};
    std::vector<std::pair<std::string, std::size_t>> each;
    for (auto& [what, point] : all)
        if (std::none_of(each.begin(), each.end(),
                         [p = point](const auto& other) { return other.second == p; }))
            each.emplace_back(what, point);
    return each;
}

Result<std::string> figure(const FrontierReport& report, const std::string& what,
                           std::size_t point) {
    const image::Image picture = report.found.points->drawn(point);
    const image::Rect worst = worst_part(report.reference, picture);
    TRY(const std::string drawn, embedded(picture, "the picture"));
    TRY(const std::string heat, embedded(image::heat_map(report.reference, picture),
                                         "its error: black is none, each doubling a step lighter"));
    TRY(const std::string crop,
        embedded(part(picture, worst), "its worst part", " class=\"crop\""));
    TRY(const std::string right,
        embedded(part(report.reference, worst), "the same of the reference", " class=\"crop\""));
    std::string caption = fmt::format("{} ({}): {:.3f} codes RMSE", what, report.name_of(point),
                                      report.found.error(point));
    if (report.timed()) caption += fmt::format(", {:.2f} ms", report.found.wall_ms(point));
    return fmt::format("<figure><figcaption>{}. Picture, error, the worst {} x {} pixels and what "
                       "they should be.</figcaption>\n<div class=\"row\">{}\n{}\n{}\n{}\n"
                       "</div></figure>\n",
                       as_markup(caption), worst.width(), worst.height(), drawn, heat, crop, right);
}

} // namespace

Result<std::string> frontier_html(const FrontierReport& report) {
    const std::string name = report.model_path.substr(report.model_path.rfind('/') + 1);
    std::string html = fmt::format(kHead, as_markup("What accuracy costs: " + name));
    for (const std::string& sentence : frontier_sentences(report))
        html += fmt::format("<p>{}</p>\n", as_markup(sentence));
    if (report.found.stopped) html += fmt::format("<p>{}</p>\n", stopped_sentence());
    html += fmt::format("<p><small>{}</small></p>\n", as_markup(frontier_head(report)));
    if (report.timed()) html += chart_svg(frontier_chart(report));
    const std::vector<ReportTable> tables = frontier_tables(report);
    for (std::size_t i = 0; i + 1 < tables.size(); ++i)
        html += table_html(tables[i]);
    html += "<h2>Pictures</h2>\n";
    for (const auto& [what, point] : shown(report)) {
        TRY(const std::string one, figure(report, what, point));
        html += one;
    }
    TRY(const std::string reference, embedded(report.reference, "the reference"));
    html += fmt::format("<figure><figcaption>The reference.</figcaption>\n<div class=\"row\">{}"
                        "</div></figure>\n",
                        reference);
    return html + table_html(tables.back()) + "</body></html>\n";
}

} // namespace scanout::app
