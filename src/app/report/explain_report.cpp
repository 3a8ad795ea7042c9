#include "app/report/explain_report.h"

#include "app/files.h"
#include "app/overlay/text_block.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

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

// The CPU time of a row: what the frame pays for it, so that what is off takes none.
std::string price_text(const EffectRow& row) {
    if (row.price->by_construction) return "same plan";
    return !row.decision.choice && !row.decision.on() ? "0" : to_string(row.price->cpu_ms);
}

// What another technique would take more: "+0.30 ± 0.02", "-0.02 ± 0.01", "0 ± 0.01".
std::string more_text(const measure::Difference& more) {
    return (more.is_zero() || more.median < 0 ? "" : "+") + to_string(more);
}

// One for each code point.
std::size_t letters_in(std::string_view utf8) {
    return static_cast<std::size_t>(
        std::count_if(utf8.begin(), utf8.end(), [](char byte) { return (byte & 0xc0) != 0x80; }));
}

std::string cut_to(std::string line, std::size_t letters) {
    while (letters_in(line) > letters) {
        while ((line.back() & 0xc0) == 0x80)
            line.pop_back();
        line.pop_back();
    }
    return line;
}

// The cells of a row, in the order of kHeads.
constexpr std::array<std::string_view, 8> kHeads = {"effect", "runs", "CPU ms", "memory",
                                                    "codes",  "FLIP", "pixels", "because"};
constexpr std::size_t kTimeColumn = 2;
using Cells = std::array<std::string, kHeads.size()>;

Cells cells(const EffectRow& row) {
    Cells c;
    c[0] = row.decision.effect;
    c[1] = row.decision.technique;
    if (row.price) c[kTimeColumn] = price_text(row);
    c[3] = bytes_text(row.bytes);
    if (row.change) {
        c[4] = fmt::format("{}", row.change->largest_code);
        c[5] = fmt::format("{:.4f}", row.change->mean_flip);
        c[6] = fmt::format("{}", row.change->pixels);
    }
    c[7] = because(row);
    return c;
}

using Columns = std::array<bool, kHeads.size()>; // columns

// A line of a table: `figures` are as long in all lines, in letters.
struct Line {
    std::string figures, reason;
};

// Names to the left, numbers to the right.
std::string figures_of(const Cells& c, const std::array<std::size_t, kHeads.size()>& width,
                       const Columns& shown) {
    std::string figures = fmt::format("{:<{}}  {:<{}}", c[0], width[0], c[1], width[1]);
    for (std::size_t i = 2; i + 1 < c.size(); ++i)
        if (shown[i]) figures += fmt::format("  {:>{}}", c[i], width[i]);
    return figures + "  ";
}

// The heads, and a line for each row.
std::vector<Line> table_of(const std::vector<EffectRow>& rows, const Columns& shown) {
    std::vector<Cells> table = {{}};
    std::copy(kHeads.begin(), kHeads.end(), table.front().begin());
    for (const EffectRow& row : rows)
        table.push_back(cells(row));
    std::array<std::size_t, kHeads.size()> width{};
    for (const Cells& c : table)
        for (std::size_t i = 0; i < c.size(); ++i)
            width[i] = std::max(width[i], letters_in(c[i]));
    std::vector<Line> lines;
    for (const Cells& c : table)
        lines.push_back({figures_of(c, width, shown), c.back()});
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

bool has_prices(const Explanation& e) {
    return std::any_of(e.rows.begin(), e.rows.end(),
                       [](const EffectRow& row) { return row.price.has_value(); });
}

std::string about_times(const Explanation& e) {
    std::string text = "CPU ms: of all threads, median ± half of its 95 % interval; same plan: "
                       "equal by construction, not timed";
    if (e.cost && !e.cost->instructions) text += "; this machine counts no instructions";
    return text;
}

} // namespace

std::string because(const EffectRow& row) {
    std::string text = row.decision.because;
    if (row.pixel_share && (row.decision.on() || row.decision.needed))
        text += fmt::format(", {:.1f} % of pixels", *row.pixel_share * 100);
    if (const auto& away = row.faces_away)
        text += fmt::format("; {} of {} triangles face away, nearest of all in {} pixel{}",
                            away->triangles, away->of, away->pixels, away->pixels == 1 ? "" : "s");
    if (row.decision.forced) text += " (forced)";
    if (!row.compared_with.empty()) text += "; compared with " + row.compared_with;
    if (const auto& other = row.automatic) {
        text += fmt::format("; {} would be chosen: {} codes, FLIP {:.4f}, {} pixels differ",
                            other->technique, other->change.largest_code, other->change.mean_flip,
                            other->change.pixels);
        if (other->price && !other->price->by_construction)
            text += fmt::format(", {} ms", more_text(-other->price->cpu_ms));
    }
    if (row.price && !row.price->by_construction && !row.decision.choice && !row.decision.on())
        text += fmt::format("; on it would take {} ms", more_text(row.price->cpu_ms));
    if (!row.refusal.empty()) text += "; " + row.refusal;
    return text;
}

std::vector<std::string> explain_table(const LoadedModel& model, const Explanation& e) {
    std::vector<std::string> lines;
    lines.push_back(fmt::format("{}  {} triangles  {}x{}  {:.1f} % of pixels covered",
                                file_name_of(model.scene.path), model.scene.counts.triangles,
                                e.width, e.height, e.covered_share * 100));
    if (e.cost)
        lines.back() +=
            fmt::format("  {:.2f} ms, {:.2f} ms of CPU time", e.cost->wall_ms, e.cost->cpu_ms);
    if (e.special == 0)
        lines.emplace_back("nothing special is called for: plain surfaces in their own colour");
    Columns shown;
    shown.fill(true);
    shown[kTimeColumn] = has_prices(e);
    for (const Line& line : table_of(e.rows, shown))
        lines.push_back(line.figures + line.reason);
    if (const std::string proof = verdict(e); !proof.empty()) lines.push_back(proof);
    if (shown[kTimeColumn]) lines.emplace_back(about_times(e));
    return lines;
}

namespace {

// Lines that stay together on a page.
using Entry = std::vector<std::string>;

// The reason may be broken into lines: beside the figures where there is room for some words in a
// line, else under them.
Entry entry_of(const Line& row, std::size_t letters) {
    constexpr std::size_t kLeast = 40, kIndent = 4;
    const std::size_t figures = letters_in(row.figures);
    if (figures + letters_in(row.reason) <= letters) return {row.figures + row.reason};
    const bool beside = figures + kLeast <= letters;
    const std::size_t left = beside ? figures : kIndent;
    Entry entry;
    if (!beside) entry.push_back(row.figures.substr(0, row.figures.find_last_not_of(' ') + 1));
    for (const std::string& part :
         broken_into_lines(row.reason, letters > left ? letters - left : 1)) {
        const std::string start = beside && entry.empty() ? row.figures : std::string(left, ' ');
        entry.push_back(start + part);
    }
    return entry;
}

// What does not run folds into one line, unless somebody asked for it or a scene calls for it.
bool folds(const frame::Decision& d) {
    return !d.forced && (d.technique == "none" || (!d.on() && !d.needed));
}

// "off: point_light, spot_light ..."; nothing where all runs.
std::vector<Entry> folded(const std::vector<std::string>& off, std::size_t letters) {
    if (off.empty()) return {};
    return {broken_into_lines(fmt::format("off: {}", fmt::join(off, ", ")), letters)};
}

// As many entries a page as fit between the head and the last lines; only one that no page holds
// is parted.
ScreenPage page_of(std::string head, std::vector<Entry> entries, const std::string& last,
                   std::size_t letters, std::size_t lines, std::size_t page) {
    std::vector<std::string> end = broken_into_lines(last, letters);
    if (end.size() > 1) entries.push_back(std::exchange(end, {})); // a small screen says it once
    while (letters_in(head) > letters && head.rfind("  ") != std::string::npos)
        head.erase(head.find_last_not_of(' ', head.rfind("  ")) + 1);
    const std::size_t around = end.size() + 2;
    const std::size_t capacity = std::max(lines, around + 1) - around;
    std::vector<std::vector<std::string>> pages(1);
    for (const Entry& entry : entries) {
        if (!pages.back().empty() && pages.back().size() + entry.size() > capacity)
            pages.emplace_back();
        for (const std::string& line : entry) {
            if (pages.back().size() == capacity) pages.emplace_back();
            pages.back().push_back(line);
        }
    }
    const std::size_t shown = std::clamp<std::size_t>(page, 1, pages.size());
    ScreenPage result{{head}, pages.size()};
    result.lines.insert(result.lines.end(), pages[shown - 1].begin(), pages[shown - 1].end());
    result.lines.insert(result.lines.end(), end.begin(), end.end());
    if (pages.size() > 1) result.lines.push_back(page_footer(shown, pages.size()));
    for (std::string& line : result.lines)
        line = cut_to(std::move(line), letters);
    return result;
}

} // namespace

ScreenPage screen_table(const Explanation& e, std::size_t measured, std::size_t letters,
                        std::size_t lines, std::size_t page) {
    constexpr std::size_t kWide = 110;  // letters: room for all columns and some of the last
    constexpr std::size_t kNarrow = 56; // no room for any figures
    Columns shown;
    shown.fill(true);
    shown[kTimeColumn] = has_prices(e) || measured < e.rows.size();
    if (letters < kWide) shown[5] = shown[6] = false; // FLIP, pixels
    if (letters < kNarrow) shown.fill(false);
    std::vector<EffectRow> running;
    std::vector<std::string> off;
    for (const EffectRow& row : e.rows) {
        if (folds(row.decision) && row.refusal.empty())
            off.push_back(row.decision.effect);
        else
            running.push_back(row);
    }
    const std::vector<Line> table = table_of(running, shown);
    std::vector<Entry> entries;
    for (std::size_t i = 1; i < table.size(); ++i)
        entries.push_back(entry_of(table[i], letters));
    for (Entry& entry : folded(off, letters))
        entries.push_back(std::move(entry));
    return page_of(table.front().figures + table.front().reason, entries,
                   measured < e.rows.size()
                       ? fmt::format("measured {} of {}", measured, e.rows.size())
                       : verdict(e),
                   letters, lines, page);
}

ScreenPage plan_lines(const frame::FramePlan& plan, bool times, std::size_t letters,
                      std::size_t lines, std::size_t page) {
    std::size_t effect = 0, runs = 0;
    std::vector<std::string> off;
    for (const frame::Decision& d : plan.decisions) {
        if (folds(d)) {
            off.push_back(d.effect);
            continue;
        }
        effect = std::max(effect, d.effect.size());
        runs = std::max(runs, d.technique.size());
    }
    const auto line = [&](std::string_view what, std::string_view how, std::string why) {
        return Line{fmt::format("{:<{}}  {:<{}}  ", what, effect, how, runs), std::move(why)};
    };
    std::vector<Entry> entries;
    for (const frame::Decision& d : plan.decisions)
        if (!folds(d))
            entries.push_back(entry_of(
                line(d.effect, d.technique, d.because + (d.forced ? " (forced)" : "")), letters));
    for (Entry& entry : folded(off, letters))
        entries.push_back(std::move(entry));
    const Line heads = line(kHeads[0], kHeads[1], std::string(kHeads.back()));
    return page_of(
        heads.figures + heads.reason, entries,
        fmt::format("{}memory and changes: when the picture stands still", times ? "times, " : ""),
        letters, lines, page);
}

} // namespace scanout::app
