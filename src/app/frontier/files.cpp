#include "app/frontier/files.h"

#include "app/report/json_text.h"
#include "app/report/report.h"
#include "measure/own_measure.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace scanout::app {
namespace {

using Json = nlohmann::ordered_json;
using measure::Point;

// Infinite values have no word in JSON.
Json json_number(double value) {
    return std::isfinite(value) ? Json(std::round(value * 1e6) / 1e6) : Json();
}

Json interval(const measure::Difference& d, double unit = 1) {
    return {{"median", json_number(d.median * unit)},
            {"low", json_number(d.low * unit)},
            {"high", json_number(d.high * unit)}};
}

Json point_json(const FrontierReport& report, std::size_t index) {
    const Point& point = (*report.found.points)[index];
    Json json = {{"options", point.options()}};
    if (report.compared())
        json.update(
            {{"rmse_codes", json_number(point.error.rmse_codes)},
             {"rmse", json_number(point.error.rmse)},
             {"psnr", json_number(image::psnr(point.error.rmse))},
             {"max_codes", point.error.max_codes},
             {"share_off_by_more_than_one", json_number(point.error.share_off)},
             {"mean_flip", point.mean_flip ? json_number(double{*point.mean_flip}) : Json()}});
    const auto own = report.found.points->cost();
    if (own && point.price) {
        json["cpu_ms"] = interval(point.price->cpu_ratio, own->cpu_ms);
        json["wall_ms"] = interval(measure::steady_wall_ratio(*point.price), own->wall_ms);
        if (own->instructions && point.price->instructions)
            json["instructions"] = *own->instructions + point.price->instructions->median;
    }
    return json;
}

Json ladder_json(const measure::Ladder& ladder) {
    Json rungs = Json::array();
    for (const measure::LadderRung& rung : ladder.rungs) {
        Json json = {{"rung", rung.technique}};
        json["point"] = rung.point ? Json(*rung.point) : Json();
        if (!rung.refusal.empty()) json["refused"] = rung.refusal;
        if (rung.own) json["own"] = json_number(*rung.own);
        rungs.push_back(std::move(json));
    }
    Json json = {{"axis", ladder.axis}, {"rungs", rungs}};
    if (!ladder.left_out.empty()) json["left_out"] = ladder.left_out;
    if (const measure::OwnMeasure* const own = measure::own_measure(ladder.axis))
        json["own"] = {{"what", own->what}, {"unit", own->unit}};
    return json;
}

Json effect_json(const measure::EffectPrice& effect) {
    return {{"effect", effect.effect},
            {"technique", effect.technique},
            {"cpu_ms", interval(effect.price.cpu_ms)},
            {"zero", effect.price.by_construction || effect.price.cpu_ms.is_zero()},
            {"changed_share", json_number(effect.changed_share)}};
}

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text)
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

// "aa 0.091 pixels; texture 3.1 codes": of the rungs that draw this point.
std::string own_text(const measure::Frontier& found, std::size_t point) {
    std::string text;
    for (const measure::Ladder& ladder : found.ladders)
        for (const measure::LadderRung& rung : ladder.rungs)
            if (rung.own && rung.point == point)
                text += fmt::format("{}{} {:.6g} {}", text.empty() ? "" : "; ", ladder.axis,
                                    *rung.own, measure::own_measure(ladder.axis)->unit);
    return text;
}

std::string csv_number(double value) {
    return std::isfinite(value) ? fmt::format("{:.6f}", value) : "inf";
}

} // namespace

std::string to_json(const FrontierReport& report) {
    const measure::Frontier& found = report.found;
    Json ladders = Json::array(), effects = Json::array(), points = Json::array(),
         frontier = Json::array();
    for (const measure::Ladder& ladder : found.ladders)
        ladders.push_back(ladder_json(ladder));
    for (const measure::EffectPrice& effect : found.effects)
        effects.push_back(effect_json(effect));
    for (std::size_t i = 0; i < found.points->all().size(); ++i)
        points.push_back(point_json(report, i));
    for (const measure::FrontierPoint& p : found.frontier)
        frontier.push_back({{"point", p.point},
                            {"times_as_long", interval(p.time)},
                            {"ties_with_next", p.ties_with_next}});
    Json reference;
    if (report.compared())
        reference = {{"samples", report.reference_samples},
                     {"standard_error", json_number(report.noise)},
                     {"ms", json_number(report.reference_ms)}};
    const Json json = {{"model", {{"path", report.model_path}, {"triangles", report.triangles}}},
                       {"width", report.width},
                       {"height", report.height},
                       {"reference", reference},
                       {"machine", report.machine},
                       {"threads", report.threads},
                       {"target", report.target},
                       {"date", report.date},
                       {"stopped", found.stopped},
                       {"sentences", frontier_sentences(report)},
                       {"ladders", ladders},
                       {"effects", effects},
                       {"points", points},
                       {"frontier", frontier},
                       {"warnings", report.warnings},
                       {"version", SCANOUT_VERSION}};
    return json_text(versioned(json));
}

std::string frontier_csv(const FrontierReport& report) {
    const measure::Frontier& found = report.found;
    std::string text = "options,rmse_codes,rmse,psnr,max_codes,share_off_by_more_than_one,"
                       "mean_flip,cpu_ms,cpu_ms_low,cpu_ms_high,wall_ms,on_frontier,own\r\n";
    const auto own = found.points->cost();
    for (std::size_t i = 0; i < found.points->all().size(); ++i) {
        const Point& p = (*found.points)[i];
        const bool on_it =
            std::any_of(found.frontier.begin(), found.frontier.end(),
                        [i](const measure::FrontierPoint& f) { return f.point == i; });
        std::vector<std::string> fields = {csv_field(report.name_of(i))};
        if (report.compared())
            for (const std::string& field :
                 {csv_number(p.error.rmse_codes), csv_number(p.error.rmse),
                  csv_number(image::psnr(p.error.rmse)), fmt::format("{}", p.error.max_codes),
                  csv_number(p.error.share_off),
                  p.mean_flip ? csv_number(double{*p.mean_flip}) : std::string()})
                fields.push_back(field);
        else
            fields.resize(fields.size() + 6);
        if (own && p.price)
            for (const double value : {found.cpu_ms(i), own->cpu_ms * p.price->cpu_ratio.low,
                                       own->cpu_ms * p.price->cpu_ratio.high, found.wall_ms(i)})
                fields.push_back(csv_number(value));
        else
            fields.resize(fields.size() + 4);
        fields.emplace_back(on_it ? "1" : "0");
        fields.push_back(csv_field(own_text(found, i)));
        text += fmt::format("{}\r\n", fmt::join(fields, ","));
    }
    return text;
}

} // namespace scanout::app
