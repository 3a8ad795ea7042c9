#include "app/report/report.h"

#include "app/frontier/measurement.h"
#include "app/report/json_text.h"
#include "base/memory.h"
#include "base/write_file.h"
#include "frame/catalogue.h"
#include "image/hash.h"
#include "simd/targets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace scanout::app {
namespace {

using Json = nlohmann::ordered_json;

double rounded(double ms) {
    return std::round(ms * 1000) / 1000;
}

template <class Member>
std::vector<double> column(const std::vector<FrameRecord>& frames, Member member) {
    std::vector<double> values;
    values.reserve(frames.size());
    for (const FrameRecord& frame : frames)
        values.push_back(frame.stats.*member);
    return values;
}

Json times(const RunReport& report) {
    using frame::FrameStats;
    const std::vector<double> total = column(report.frames, &FrameStats::total_ms);
    const auto median = [&](auto member) {
        return rounded(percentile(column(report.frames, member), 0.5));
    };
    return {{"load", rounded(report.load_ms)},
            {"parse", rounded(report.load_times.parse)},
            {"build", rounded(report.load_times.build)},
            {"first", rounded(total.empty() ? 0 : total.front())},
            {"median", rounded(percentile(total, 0.5))},
            {"min", rounded(percentile(total, 0))},
            {"p95", rounded(percentile(total, 0.95))},
            {"encode", rounded(report.encode_ms)},
            {"stages",
             {{"geometry", median(&FrameStats::geometry_ms)},
              {"tiles", median(&FrameStats::tiles_ms)}}}};
}

Json change_json(const measure::Change& change) {
    return {{"pixels", change.pixels},
            {"largest_code", change.largest_code},
            {"mean_flip", change.mean_flip}};
}

Json difference_json(const measure::Difference& d) {
    const auto value = [](double x) { return std::round(x * 1e4) / 1e4; };
    return {{"median", value(d.median)},
            {"low", value(d.low)},
            {"high", value(d.high)},
            {"zero", d.is_zero()}};
}

Json price_json(const measure::Price& price) {
    if (price.by_construction) return {{"same_plan", true}};
    Json json = {{"same_plan", false},
                 {"pairs", price.pairs},
                 {"cpu_ms", difference_json(price.cpu_ms)},
                 {"wall_ms", difference_json(price.wall_ms)}};
    json["instructions"] =
        price.instructions ? difference_json(*price.instructions) : Json(nullptr);
    return json;
}

Json chosen_json(const Chosen& chosen) {
    const auto limit = [](const std::optional<double>& value) {
        return value ? Json(*value) : Json(nullptr);
    };
    return {{"options", chosen.point.options()},
            {"ms", rounded(chosen.point.wall_ms)},
            {"rmse_codes", std::round(chosen.point.error * 1e4) / 1e4},
            {"budget_ms", limit(chosen.limits.wall_ms)},
            {"max_error", limit(chosen.limits.error)},
            {"met", chosen.choice.met()},
            {"measured", chosen.date},
            {"cached", chosen.cached}};
}

Json effect_json(const measure::EffectRow& row) {
    const frame::Decision& d = row.decision;
    Json json = {{"effect", d.effect}, {"on", d.on()},       {"technique", d.technique},
                 {"needed", d.needed}, {"forced", d.forced}, {"because", d.because},
                 {"bytes", row.bytes}};
    json["pixel_share"] = row.pixel_share ? Json(*row.pixel_share) : Json(nullptr);
    if (row.change) {
        json["switched"] = change_json(*row.change);
    } else {
        json["switched"] = nullptr;
        if (!row.refusal.empty()) json["refused"] = row.refusal;
    }
    if (const auto& away = row.faces_away)
        json["faces_away"] = {
            {"triangles", away->triangles}, {"of", away->of}, {"pixels", away->pixels}};
    if (!row.compared_with.empty()) json["compared_with"] = row.compared_with;
    if (row.automatic) {
        json["automatic"] = change_json(row.automatic->change);
        json["automatic"]["technique"] = row.automatic->technique;
        if (row.automatic->price) json["automatic"]["time"] = price_json(-*row.automatic->price);
    }
    if (row.price) json["time"] = price_json(*row.price);
    return json;
}

} // namespace

double percentile(std::vector<double> values, double fraction) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const double rank = std::ceil(fraction * static_cast<double>(values.size()));
    return values[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

static Json run_json(const RunReport& report) {
    Json frames = Json::array();
    for (const FrameRecord& frame : report.frames)
        frames.push_back({{"index", frame.index},
                          {"hash", image::hash_text(frame.hash)},
                          {"width", frame.width},
                          {"height", frame.height},
                          {"ms", rounded(frame.stats.total_ms)}});
    for (std::size_t i = 0; i < report.frames.size(); ++i)
        if (const auto covered = report.frames[i].covered_pixels)
            frames[i]["covered_pixels"] = *covered;
    for (std::size_t i = 0; i < report.references.size(); ++i) {
        const ReferenceRecord& r = report.references[i];
        frames[i]["reference"] = {{"samples", r.samples},
                                  {"standard_error", std::round(r.error * 1e4) / 1e4},
                                  {"unsure_pixels", r.unsure_pixels}};
    }
    const frame::FrameStats drawn =
        report.frames.empty() ? frame::FrameStats{} : report.frames.front().stats;
    const scene::ModelCounts& counts = report.counts;
    Json json = {
        {"model",
         {{"path", report.model_path},
          {"vertices", counts.vertices},
          {"faces", counts.faces},
          {"triangles", counts.triangles},
          {"lines", counts.lines},
          {"points", counts.points},
          {"skipped", counts.skipped},
          {"bytes", counts.bytes}}},
        {"frames", frames},
        {"ms", times(report)},
        {"triangles", {{"submitted", drawn.triangles_submitted}, {"drawn", drawn.triangles_drawn}}},
        {"warnings", report.warnings},
        {"rss_start_bytes", report.start_bytes},
        {"peak_rss_bytes", peak_resident_bytes()},
        {"threads", report.threads},
        {"target", simd::chosen_target()},
        {"version", SCANOUT_VERSION}};
    if (!report.measured.empty()) {
        const Measured found = measure_points(report.measured);
        Json points = Json::array();
        for (const DVec3& p : report.measured)
            points.push_back({p.x, p.y, p.z});
        json["measured"] = {{"points", points}, {"distances", found.distances}};
        if (found.angle) json["measured"]["angle"] = *found.angle;
    }
    if (const std::vector<double>& ms = report.input_to_screen_ms; !ms.empty())
        json["input_to_screen_ms"] = {{"count", ms.size()},
                                      {"median", rounded(percentile(ms, 0.5))},
                                      {"p99", rounded(percentile(ms, 0.99))}};
    if (report.chosen) json["chosen"] = chosen_json(*report.chosen);
    return json;
}

std::string to_json(const RunReport& report) {
    return json_text(versioned(run_json(report)));
}

std::string to_json(const std::vector<RunReport>& reports) {
    Json runs = Json::array();
    for (const RunReport& report : reports)
        runs.push_back(versioned(run_json(report)));
    return json_text(runs);
}

std::string to_json(const Comparison& compared, const Settings& settings,
                    const std::vector<std::string>& written) {
    const image::Difference& d = compared.difference;
    // Of pictures of one size, and no infinite one: JSON has no word for it.
    const auto figure = [&](double value) {
        return d.same_size && std::isfinite(value) ? Json(std::round(value * 1e6) / 1e6) : Json();
    };
    Json tolerance = {{"max_diff", settings.max_difference}, {"max_pixels", settings.max_pixels}};
    if (settings.metric != Metric::none)
        tolerance = {{"metric", text_of(settings.metric)},
                     {"limit", settings.limit ? Json(*settings.limit) : Json()}};
    return json_text(versioned({{"same", compared.same(settings)},
                                {"same_size", d.same_size},
                                {"max_difference", d.max_difference},
                                {"differing_pixels", d.differing_pixels},
                                {"over_tolerance", d.over_tolerance},
                                {"mean_flip", figure(compared.figure(Metric::flip))},
                                {"rmse", figure(compared.figure(Metric::rmse))},
                                {"rmse_codes", figure(compared.figure(Metric::rmse_codes))},
                                {"psnr", figure(compared.figure(Metric::psnr))},
                                {"ssim", figure(compared.figure(Metric::ssim))},
                                {"share_off_by_more_than_one", figure(compared.metrics.share_off)},
                                {"tolerance", tolerance},
                                {"written", written},
                                {"version", SCANOUT_VERSION}}));
}

std::string to_json(const LoadedModel& model, const measure::Explanation& e) {
    Json effects = Json::array(), techniques = Json::array();
    for (const measure::EffectRow& row : e.rows)
        effects.push_back(effect_json(row));
    for (const Technique* t : e.techniques)
        techniques.push_back({{"axis", t->axis}, {"name", t->name}});
    Json json = {
        {"model", {{"path", model.scene.path}, {"triangles", model.scene.counts.triangles}}},
        {"width", e.width},
        {"height", e.height},
        {"covered_share", e.covered_share},
        {"special", e.special},
        {"effects", effects},
        {"techniques", techniques},
        {"warnings", model.warnings},
        {"version", SCANOUT_VERSION}};
    if (e.cost) {
        json["ms"] = rounded(e.cost->wall_ms);
        json["cpu_ms"] = rounded(e.cost->cpu_ms);
        json["instructions"] = e.cost->instructions ? Json(*e.cost->instructions) : Json(nullptr);
    }
    return json_text(versioned(json));
}

Result<void> write_report(const Settings& settings, const std::string& json) {
    if (!settings.json) return {};
    return write_file(*settings.json, json);
}

} // namespace scanout::app
