#include "app/files.h"
#include "app/frontier/chart.h"
#include "app/frontier/files.h"
#include "app/frontier/pictures.h"
#include "app/report/markup.h"
#include "base/base64.h"
#include "image/codec.h"

#include <fmt/format.h>

namespace scanout::app {
namespace {

constexpr std::string_view kHtmlHead =
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

Result<std::string> figure(const FrontierReport& report, const ShownPoint& shown) {
    const PointPictures pictures = pictures_of(report, shown.point);
    TRY(const std::string drawn, embedded(pictures.drawn, "the picture"));
    TRY(const std::string heat,
        embedded(pictures.heat, "its error: black is none, each doubling a step lighter"));
    TRY(const std::string crop, embedded(pictures.crop, "its worst part", " class=\"crop\""));
    TRY(const std::string right,
        embedded(pictures.right, "the same of the reference", " class=\"crop\""));
    return fmt::format("<figure><figcaption>{}. Picture, error, the worst {} x {} pixels and what "
                       "they should be.</figcaption>\n<div class=\"row\">{}\n{}\n{}\n{}\n"
                       "</div></figure>\n",
                       as_markup(caption_of(report, shown)), pictures.crop.width(),
                       pictures.crop.height(), drawn, heat, crop, right);
}

Result<std::string> pictures_html(const FrontierReport& report) {
    std::string html = "<h2>Pictures</h2>\n";
    for (const ShownPoint& shown : shown_points(report)) {
        TRY(const std::string one, figure(report, shown));
        html += one;
    }
    TRY(const std::string reference, embedded(report.reference, "the reference"));
    html += fmt::format("<figure><figcaption>The reference.</figcaption>\n<div class=\"row\">{}"
                        "</div></figure>\n",
                        reference);
    return html;
}

} // namespace

Result<std::string> frontier_html(const FrontierReport& report) {
    const std::string name = file_name_of(report.model_path);
    std::string html = fmt::format(kHtmlHead, as_markup("What accuracy costs: " + name));
    for (const std::string& sentence : frontier_sentences(report))
        html += fmt::format("<p>{}</p>\n", as_markup(sentence));
    if (report.found.stopped) html += fmt::format("<p>{}</p>\n", stopped_sentence(report.found));
    html += fmt::format("<p><small>{}</small></p>\n", as_markup(frontier_head(report)));
    if (report.has_frontier()) html += chart_svg(frontier_chart(report));
    const std::vector<ReportTable> tables = frontier_tables(report);
    for (std::size_t i = 0; i + 1 < tables.size(); ++i)
        html += table_html(tables[i]);
    if (report.compared()) {
        TRY(const std::string pictures, pictures_html(report));
        html += pictures;
    }
    return html + table_html(tables.back()) + "</body></html>\n";
}

} // namespace scanout::app
