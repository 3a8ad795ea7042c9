#include "app/frontier/report.h"

#include "app/files.h"
#include "app/frontier/chart.h"
#include "measure/own_measure.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace scanout::app {
namespace {

using measure::Frontier;
using measure::Ladder;
using measure::LadderRung;
using measure::Point;

std::string codes(double error) {
    return fmt::format("{:.3f}", error);
}

std::string psnr_text(double rmse) {
    const double psnr = image::psnr(rmse);
    return std::isfinite(psnr) ? fmt::format("{:.2f}", psnr) : "inf";
}

std::string wall_text(const Frontier& found, std::size_t point) {
    if (!(*found.points)[point].price) return "";
    return fmt::format("{:.2f}", found.wall_ms(point));
}

std::string nothing_of(const Frontier& found) {
    return found.untimed_rungs().empty() ? "nothing" : "nothing that was timed";
}

ReportTable equal_time(const FrontierReport& report) {
    const Frontier& found = report.found;
    ReportTable table{
        "What a time buys", {{"ms a frame", "codes RMSE", "takes ms", "CPU ms", "with"}}, {}};
    for (const double budget : {4.0, 8.0, 16.7, 33.0}) {
        const auto best = found.best_within(budget);
        const std::string head = fmt::format("{:.1f}", budget);
        if (best)
            table.rows.push_back({head, codes(found.error(*best)), wall_text(found, *best),
                                  report.cpu_text(*best), report.name_of(*best)});
        else
            table.rows.push_back({head, "-", "", "",
                                  fmt::format("{}: the quickest takes {:.2f} ms", nothing_of(found),
                                              found.least_wall_ms())});
    }
    return table;
}

// A rung that was drawn and not timed may be what was looked for.
std::string why_none_errs(const FrontierReport& report, double error) {
    const Frontier& found = report.found;
    for (const std::size_t point : found.untimed_rungs())
        if (found.error(point) <= error)
            return fmt::format("{}; {} errs {:.3f} codes", nothing_of(found), report.name_of(point),
                               found.error(point));
    return fmt::format("{}: the most accurate errs {:.3f} codes", nothing_of(found),
                       found.error(found.frontier.back().point));
}

ReportTable equal_error(const FrontierReport& report) {
    const Frontier& found = report.found;
    ReportTable table{
        "What an error costs", {{"codes RMSE", "ms a frame", "CPU ms", "errs", "with"}}, {}};
    for (const double error : {4.0, 2.0, 1.0, 0.5}) {
        const auto quickest = found.quickest_below(error);
        const std::string head = fmt::format("{:.1f}", error);
        if (quickest)
            table.rows.push_back({head, wall_text(found, *quickest), report.cpu_text(*quickest),
                                  codes(found.error(*quickest)), report.name_of(*quickest)});
        else
            table.rows.push_back({head, "-", "", "", why_none_errs(report, error)});
    }
    return table;
}

ReportTable frontier_table(const FrontierReport& report) {
    const Frontier& found = report.found;
    ReportTable table{"The frontier (~: its time and the next one's cannot be told apart)",
                      {{"", "codes RMSE", "FLIP", "ms a frame", "CPU ms", "with"}},
                      {}};
    int number = 0;
    for (const auto& p : found.frontier) {
        const Point& point = (*found.points)[p.point];
        table.rows.push_back({fmt::format("{}{}", ++number, p.ties_with_next ? " ~" : ""),
                              codes(found.error(p.point)),
                              point.mean_flip ? fmt::format("{:.4f}", *point.mean_flip) : "",
                              wall_text(found, p.point), report.cpu_text(p.point),
                              report.name_of(p.point)});
    }
    return table;
}

std::vector<std::string> ladder_row(const FrontierReport& report, const Ladder& ladder,
                                    const LadderRung& rung) {
    std::vector<std::string> row = {std::string(ladder.axis), std::string(rung.technique)};
    if (!rung.point) {
        row.insert(row.end(), (report.compared() ? 5 : 0) + (report.timed() ? 2 : 0) + 1, "");
        row.back() = rung.refusal;
        return row;
    }
    const Point& point = (*report.found.points)[*rung.point];
    if (report.compared()) {
        row.push_back(codes(point.error.rmse_codes));
        row.push_back(psnr_text(point.error.rmse));
        row.push_back(fmt::format("{}", point.error.max_codes));
        row.push_back(fmt::format("{:.2f}", point.error.share_off * 100));
        row.push_back(rung.own ? fmt::format("{:.3g}", *rung.own) : "");
    }
    if (report.timed()) {
        row.push_back(wall_text(report.found, *rung.point));
        row.push_back(report.cpu_text(*rung.point));
    }
    row.emplace_back(*rung.point == 0 ? "as asked for" : "");
    return row;
}

bool has_own(const Ladder& ladder) {
    return std::any_of(ladder.rungs.begin(), ladder.rungs.end(),
                       [](const LadderRung& rung) { return rung.own.has_value(); });
}

ReportTable ladder_table(const FrontierReport& report) {
    ReportTable table{"The ladders: each rung, all else as asked for", {}, {}};
    table.rows.push_back({"axis", "rung"});
    if (report.compared())
        for (const char* const head :
             {"codes RMSE", "PSNR dB", "largest", "% off by over a code", "own"})
            table.rows.back().emplace_back(head);
    if (report.timed()) {
        table.rows.back().emplace_back("ms a frame");
        table.rows.back().emplace_back("CPU ms");
    }
    table.rows.back().emplace_back("");
    std::vector<std::string_view> flat, missing;
    for (const Ladder& ladder : report.found.ladders) {
        if (!ladder.left_out.empty())
            table.notes.push_back(fmt::format("{}: {}", ladder.axis, ladder.left_out));
        else if (ladder.rungs.empty())
            missing.push_back(ladder.axis);
        else if (ladder.is_flat())
            flat.push_back(ladder.axis);
        else
            for (const LadderRung& rung : ladder.rungs)
                table.rows.push_back(ladder_row(report, ladder, rung));
        const measure::OwnMeasure* const own = measure::own_measure(ladder.axis);
        if (own != nullptr && has_own(ladder))
            table.notes.push_back(
                fmt::format("own: {}: {}, {}", ladder.axis, own->what, own->unit));
    }
    if (!flat.empty())
        table.notes.push_back(
            fmt::format("not called for, all rungs draw the same: {}", fmt::join(flat, ", ")));
    if (!missing.empty())
        table.notes.push_back(fmt::format("not measured: {}", fmt::join(missing, ", ")));
    return table;
}

std::size_t letters_of(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    }));
}

// Figures to the right; the first column and the last to the left.
std::vector<std::string> aligned(const Rows& rows) {
    std::vector<std::size_t> width(rows.front().size());
    for (const auto& row : rows)
        for (std::size_t i = 0; i < row.size(); ++i)
            width[i] = std::max(width[i], letters_of(row[i]));
    std::vector<std::string> lines;
    for (const auto& row : rows) {
        std::string line = " ";
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::string blanks(width[i] - letters_of(row[i]), ' ');
            const bool left = i == 0 || i + 1 == row.size() || rows.front()[i] == "rung";
            line += left ? " " + row[i] + blanks + " " : " " + blanks + row[i] + " ";
        }
        line.resize(line.find_last_not_of(' ') + 1);
        lines.push_back(std::move(line));
    }
    return lines;
}

} // namespace

std::string FrontierReport::name_of(std::size_t point) const {
    const std::string options = (*found.points)[point].options();
    return options.empty() ? "as asked for" : options;
}

std::string FrontierReport::cpu_text(std::size_t point) const {
    const auto& price = (*found.points)[point].price;
    if (!price) return "";
    if (point == 0) return fmt::format("{:.2f}", found.cpu_ms(point)); // what others are times of
    const double half = price->cpu_ratio.half_width() * found.points->cost()->cpu_ms;
    return fmt::format("{:.2f} ± {:.2f}", found.cpu_ms(point), half);
}

std::vector<ReportTable> frontier_tables(const FrontierReport& report) {
    if (!report.has_frontier()) return {ladder_table(report)};
    return {equal_time(report), equal_error(report), frontier_table(report), ladder_table(report)};
}

std::string frontier_head(const FrontierReport& report) {
    std::string text =
        fmt::format("{}: {} triangle{}, {}x{}; ", file_name_of(report.model_path), report.triangles,
                    report.triangles == 1 ? "" : "s", report.width, report.height);
    text +=
        report.compared()
            ? fmt::format("reference of {:.1f} samples a pixel, its own noise {:.3f} codes RMSE",
                          static_cast<double>(report.reference_samples) /
                              (static_cast<double>(report.width) * report.height),
                          report.noise)
            : "no reference, so no errors";
    if (report.timed())
        text += fmt::format("; {}, {} thread{}, {}, {}", report.machine, report.threads,
                            report.threads == 1 ? "" : "s", report.target, report.date);
    return text;
}

std::string stopped_sentence(const Frontier& found) {
    std::string text = found.interrupted
                           ? "Not all was measured: it was interrupted"
                           : "Not all was measured: the time was up (--seconds gives more)";
    const std::size_t untimed = found.untimed_rungs().size(), drawn = found.drawn_rungs().size();
    if (untimed > 0) text += fmt::format("; {} of {} rungs have no time", untimed, drawn);
    return text + ".";
}

std::vector<std::string> frontier_text(const FrontierReport& report) {
    std::vector<std::string> lines = frontier_sentences(report);
    lines.push_back(frontier_head(report));
    if (report.found.stopped) lines.push_back(stopped_sentence(report.found));
    const std::vector<ReportTable> tables = frontier_tables(report);
    for (std::size_t i = 0; i < tables.size(); ++i) {
        lines.emplace_back();
        lines.push_back(tables[i].title);
        const std::vector<std::string> table = aligned(tables[i].rows);
        lines.insert(lines.end(), table.begin(), table.end());
        for (const std::string& note : tables[i].notes)
            lines.push_back("  " + note);
        if (!report.has_frontier() || i + 2 != tables.size()) continue;
        const std::vector<std::string> plot =
            text_plot(frontier_chart(report)); // under the frontier
        lines.insert(lines.end(), plot.begin(), plot.end());
    }
    return lines;
}

} // namespace scanout::app
