#include "app/frontier/chart.h"

#include "app/files.h"
#include "app/frontier/chart_axes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace scanout::app {
namespace {

ChartPoint chart_point(const FrontierReport& report, std::size_t point, int number) {
    const measure::Frontier& found = report.found;
    ChartPoint p;
    const measure::Difference ratio = (*found.points)[point].price->cpu_ratio;
    p.time = std::max(found.cpu_ms(point), kLeastTime);
    p.time_low = p.time * ratio.low / ratio.median;
    p.time_high = p.time * ratio.high / ratio.median;
    p.error = found.error(point);
    const double square = p.error * p.error, noise = report.noise * report.noise;
    p.error_low = std::sqrt(std::max(square - noise, 0.0));
    p.error_high = std::sqrt(square + noise);
    p.number = number;
    p.asked = point == 0;
    p.name = report.name_of(point);
    return p;
}

} // namespace

Chart frontier_chart(const FrontierReport& report) {
    const measure::Frontier& found = report.found;
    Chart chart;
    chart.title = file_name_of(report.model_path) +
                  fmt::format(" at {}x{}: what accuracy costs", report.width, report.height);
    chart.noise = report.noise;
    std::vector<bool> on_it(found.points->all().size());
    int number = 0;
    for (const measure::FrontierPoint& p : found.frontier) {
        on_it[p.point] = true;
        chart.points.push_back(chart_point(report, p.point, ++number));
    }
    for (std::size_t i = 0; i < on_it.size(); ++i)
        if (!on_it[i] && (*found.points)[i].price)
            chart.points.push_back(chart_point(report, i, 0));
    return chart;
}

std::vector<std::string> text_plot(const Chart& chart) {
    constexpr int kColumns = 60, kRows = 16;
    const ChartAxes axes = axes_of(chart);
    const auto row_of = [&](double error) {
        return static_cast<std::size_t>(std::lround((1 - axes.error.place(error)) * (kRows - 1)));
    };
    const auto column_of = [&](double time) {
        return static_cast<std::size_t>(std::lround(axes.time.place(time) * (kColumns - 1)));
    };
    std::vector<std::string> cells(kRows, std::string(kColumns, ' '));
    for (std::size_t row = row_of(chart.noise); row < cells.size(); ++row)
        cells[row].assign(kColumns, ':');
    for (auto p = chart.points.rbegin(); p != chart.points.rend(); ++p)
        cells[row_of(p->error)][column_of(p->time)] = p->asked ? '@' : p->number > 0 ? 'O' : '.';
    std::vector<std::string> heads(kRows);
    for (const double tick : axes.error.ticks())
        heads[row_of(tick)] = fmt::format("{:g}", tick);
    std::vector<std::string> lines = {
        "  codes RMSE   O the frontier  @ as asked for  . beside it  : noise of the reference"};
    for (std::size_t row = 0; row < cells.size(); ++row) {
        const std::string line = fmt::format("  {:>6} |{}", heads[row], cells[row]);
        lines.push_back(line.substr(0, line.find_last_not_of(' ') + 1));
    }
    std::string feet(kColumns + 6, ' ');
    for (const double tick : axes.time.ticks()) {
        const std::string text = fmt::format("{:g}", tick);
        feet.replace(column_of(tick), text.size(), text);
    }
    lines.push_back("         +" + std::string(kColumns, '-'));
    lines.push_back("          " + feet.substr(0, feet.find_last_not_of(' ') + 1) + "  CPU ms");
    return lines;
}

} // namespace scanout::app
