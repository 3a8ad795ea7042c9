#include "app/explain_report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace scanout::app {
namespace {

using measure::EffectRow;
using measure::Explanation;

std::string bytes_text(std::uint64_t bytes) {
    if (bytes == 0) return "0";
    if (bytes < 10 * 1024) return fmt::format("{} B", bytes);
    if (bytes < 10 * 1024 * 1024) return fmt::format("{} KiB", bytes / 1024);
    return fmt::format("{} MiB", bytes / (1024 * 1024));
}

// Never "-0.00".
std::string milliseconds_text(double ms) {
    return fmt::format("{:.2f}", std::abs(ms) < 0.005 ? 0.0 : ms);
}

// The cells of a row, in the order of kHeads.
constexpr std::array<std::string_view, 8> kHeads = {"effect", "runs", "ms",     "memory",
                                                    "codes",  "FLIP", "pixels", "because"};
constexpr std::size_t kTimeColumn = 2;
using Cells = std::array<std::string, kHeads.size()>;

Cells cells(const EffectRow& row) {
    Cells c;
    c[0] = row.decision.effect;
    c[1] = row.decision.technique;
    if (row.milliseconds) c[kTimeColumn] = milliseconds_text(*row.milliseconds);
    c[3] = bytes_text(row.bytes);
    if (row.change) {
        c[4] = fmt::format("{}", row.change->largest_code);
        c[5] = fmt::format("{:.4f}", row.change->mean_flip);
        c[6] = fmt::format("{}", row.change->pixels);
    }
    c[7] = because(row);
    return c;
}

using Shown = std::array<bool, kHeads.size()>; // columns

// Names to the left, numbers to the right; the last column as it is.
std::string line_of(const Cells& c, const std::array<std::size_t, kHeads.size()>& width,
                    const Shown& shown) {
    std::string line = fmt::format("{:<{}}  {:<{}}", c[0], width[0], c[1], width[1]);
    for (std::size_t i = 2; i + 1 < c.size(); ++i)
        if (shown[i]) line += fmt::format("  {:>{}}", c[i], width[i]);
    return line + "  " + c.back();
}

// The heads, and a line for each of these rows.
std::vector<std::string> table_of(const std::vector<const EffectRow*>& rows, const Shown& shown) {
    std::vector<Cells> table = {{}};
    std::copy(kHeads.begin(), kHeads.end(), table.front().begin());
    for (const EffectRow* row : rows)
        table.push_back(cells(*row));
    std::array<std::size_t, kHeads.size()> width{};
    for (const Cells& c : table)
        for (std::size_t i = 0; i < c.size(); ++i)
            width[i] = std::max(width[i], c[i].size());
    std::vector<std::string> lines;
    for (const Cells& c : table)
        lines.push_back(line_of(c, width, shown));
    return lines;
}

// What the columns do not say by themselves: what proves that a row that is off may be off.
std::string verdict(const Explanation& explanation) {
    int off = 0, missing = 0;
    for (const EffectRow& row : explanation.rows) {
        if (row.decision.on() || !row.change) continue;
        ++off;
        missing += row.change->pixels != 0 ? 1 : 0;
    }
    if (off == 0) return "";
    if (missing == 0)
        return fmt::format("switching on any of the {} that are off: 0 pixels differ", off);
    return fmt::format("switching on what is off changes pixels in {} of {} rows", missing, off);
}

} // namespace

std::string because(const EffectRow& row) {
    std::string text = row.decision.because;
    if (row.pixel_share && (row.decision.on() || *row.pixel_share > 0))
        text += fmt::format(", {:.1f} % of pixels", *row.pixel_share * 100);
    if (const auto& away = row.faces_away)
        text += fmt::format("; {} of {} triangles face away, in {} pixel{}", away->triangles,
                            away->of, away->pixels, away->pixels == 1 ? "" : "s");
    if (row.decision.forced) text += " (forced)";
    if (!row.cheapest.empty()) text += "; compared with " + row.cheapest;
    if (!row.refusal.empty()) text += "; " + row.refusal;
    return text;
}

std::vector<std::string> explain_table(const LoadedModel& model, const Explanation& e) {
    const std::string& path = model.scene.path;
    std::vector<std::string> lines;
    lines.push_back(fmt::format("{}  {} triangles  {}x{}  {:.1f} % of pixels covered",
                                path.substr(path.rfind('/') + 1), model.scene.counts.triangles,
                                e.width, e.height, e.covered_share * 100));
    if (e.milliseconds) lines.back() += fmt::format("  {:.2f} ms", *e.milliseconds);
    if (e.special == 0)
        lines.emplace_back("nothing special is called for: plain surfaces in their own colour");
    std::vector<const EffectRow*> rows;
    for (const EffectRow& row : e.rows)
        rows.push_back(&row);
    Shown shown;
    shown.fill(true);
    shown[kTimeColumn] = e.milliseconds.has_value();
    const std::vector<std::string> table = table_of(rows, shown);
    lines.insert(lines.end(), table.begin(), table.end());
    if (const std::string proof = verdict(e); !proof.empty()) lines.push_back(proof);
    return lines;
}

std::vector<std::string> screen_table(const Explanation& e, std::size_t measured,
                                      std::size_t letters, std::size_t lines) {
    std::vector<const EffectRow*> rows;
    for (const EffectRow& row : e.rows)
        rows.push_back(&row);
    constexpr std::size_t kOthers = 2; // the heads, and the line at the end
    std::size_t left_out = 0;
    for (std::size_t i = rows.size(); i-- > 0 && rows.size() + kOthers > lines;) {
        if (rows[i]->decision.on()) continue;
        rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(i));
        ++left_out;
    }
    constexpr std::size_t kWide = 110; // letters: room for all columns and some of the last
    Shown shown;
    shown.fill(true);
    if (letters < kWide) shown[5] = shown[6] = false; // FLIP, pixels
    std::vector<std::string> table = table_of(rows, shown);
    std::string last = measured < e.rows.size()
                           ? fmt::format("measured {} of {}", measured, e.rows.size())
                           : verdict(e);
    if (left_out > 0)
        last += fmt::format("{}{} that are off: not shown", last.empty() ? "" : "; ", left_out);
    table.push_back(std::move(last));
    for (std::string& line : table)
        if (line.size() > letters) line.resize(letters);
    return table;
}

std::vector<std::string> plan_lines(const frame::FramePlan& plan, std::size_t letters) {
    std::size_t effect = 0, runs = 0;
    for (const frame::Decision& d : plan.decisions) {
        effect = std::max(effect, d.effect.size());
        runs = std::max(runs, d.technique.size());
    }
    std::vector<std::string> lines;
    for (const frame::Decision& d : plan.decisions) {
        lines.push_back(fmt::format("{:<{}}  {:<{}}  {}{}", d.effect, effect, d.technique, runs,
                                    d.because, d.forced ? " (forced)" : ""));
    }
    lines.emplace_back("costs and changes: scanout explain");
    for (std::string& line : lines)
        if (line.size() > letters) line.resize(letters);
    return lines;
}

} // namespace scanout::app
