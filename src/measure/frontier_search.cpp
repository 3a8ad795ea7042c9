// The search for the frontier: what is measured, in which order, and when it ends.
#include "base/stopwatch.h"
#include "measure/frontier.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace scanout::measure {
namespace {

bool overlap(const Difference& a, const Difference& b) {
    return a.low <= b.high && b.low <= a.high;
}

// Measures, and ends where it is told to or the time is up.
class Search {
public:
    Search(Frontier& found, const FrontierOptions& how)
        : found_(found), points_(*found.points), how_(how) {}

    void run() {
        make_ladders();
        if (how_.times) {
            watch_.restart(); // all that is drawn at all was drawn once
            found_.stopped = stopped_;
            stopped_ = how_.stop && how_.stop(); // the time for drawing was up, that for timing not
            if (!stopped_) points_.time(0, how_.seconds_a_point); // what is asked for, at least
            price_effects();
            time_ladders();
            climb();
            draw_frontier();
        }
        look();
        found_.stopped = found_.stopped || stopped_;
    }

private:
    // A rung of an axis on the way up: what it costs and errs beside the other axes' defaults.
    struct Step {
        std::string_view technique;
        std::size_t point = 0;
    };
    struct Way {
        std::string_view axis;
        std::vector<Step> steps;
        std::size_t at = 0;
    };

    bool stop() {
        stopped_ =
            stopped_ || (how_.stop && how_.stop()) || watch_.milliseconds() > how_.seconds * 1000;
        return stopped_;
    }
    void tell(double fraction) const {
        if (how_.progress) how_.progress(fraction);
    }

    void make_ladders() {
        for (const std::string_view axis : ladder_axes()) {
            const auto& asked = how_.axes;
            if (!asked.empty() && std::find(asked.begin(), asked.end(), axis) == asked.end())
                continue;
            found_.ladders.push_back(ladder(points_, axis, [this] { return stop(); }));
            tell(0.05 * static_cast<double>(found_.ladders.size()) /
                 static_cast<double>(asked.empty() ? ladder_axes().size() : asked.size()));
        }
    }

    // So that slow rungs leave time for what comes after them, each part ends by its share of it.
    bool stop_at(double share) {
        if (stop()) return true;
        const bool late = watch_.milliseconds() > share * how_.seconds * 1000;
        found_.stopped = found_.stopped || late;
        return late;
    }

    // The frame with each effect that is on, and without. Lights are left out: they take shadows
    // and highlights with them, whose time is not their own.
    void price_effects() {
        const std::vector<frame::Decision> decisions = points_[0].plan.decisions;
        const double pixels =
            static_cast<double>(points_.options().width) * points_.options().height;
        for (const frame::Decision& d : decisions) {
            if (!d.on() || d.choice) continue;
            if (stop_at(0.2)) break;
            frame::FrameOptions options = points_.options();
            options.effects[d.effect] = false;
            const auto without = points_.plan(options);
            if (!without || without->lights.size() != points_[0].plan.lights.size()) continue;
            const Points::Saving saving = points_.saving(*without, how_.seconds_a_point);
            found_.effects.push_back(
                {d.effect, d.technique, saving.price, static_cast<double>(saving.pixels) / pixels});
        }
        tell(0.15);
    }

    // Quick ones first: there are more of them on the frontier.
    void time_ladders() {
        std::vector<std::size_t> order(points_.all().size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return points_[a].first_ms < points_[b].first_ms;
        });
        for (std::size_t i = 0; i < order.size() && !stop_at(0.65); ++i) {
            points_.time(order[i], how_.seconds_a_point);
            tell(0.15 + 0.45 * static_cast<double>(i + 1) / static_cast<double>(order.size()));
        }
    }

    // Of two points: the first errs no more than the other by a tenth of a code, where errors add
    // up as squares. Less is not worth a word.
    bool as_accurate(std::size_t a, std::size_t b) const {
        constexpr double kTold = 0.1; // codes
        return found_.error(a) * found_.error(a) <=
               found_.error(b) * found_.error(b) + kTold * kTold;
    }
    // Of whole pictures: enough to be worth a step, a fiftieth at least.
    bool buys(std::size_t from, std::size_t to) const {
        return !as_accurate(from, to) && found_.error(to) < 0.98 * found_.error(from);
    }
    // And the time of s may be as short as that of r.
    bool as_good(const Step& s, const Step& r) const {
        return points_[s.point].price->cpu_ratio.low <= points_[r.point].price->cpu_ratio.high &&
               as_accurate(s.point, r.point);
    }
    // Of two that are as good as each other: what is asked for, else the higher rung.
    bool replaces(const Step& s, const Step& r) const {
        return as_good(s, r) && (!as_good(r, s) || s.point == 0 || (r.point != 0 && &s > &r));
    }

    // The rungs of an axis that no other one can stand for, quickest first.
    Way way_up(const Ladder& ladder) const {
        std::vector<Step> steps;
        for (const LadderRung& rung : ladder.rungs)
            if (rung.point && points_[*rung.point].price)
                steps.push_back({rung.technique, *rung.point});
        Way way{ladder.axis, {}, 0};
        std::copy_if(steps.begin(), steps.end(), std::back_inserter(way.steps), [&](const Step& r) {
            return std::none_of(steps.begin(), steps.end(),
                                [&](const Step& s) { return &s != &r && replaces(s, r); });
        });
        std::stable_sort(way.steps.begin(), way.steps.end(), [&](const Step& a, const Step& b) {
            return found_.cpu_ms(a.point) < found_.cpu_ms(b.point);
        });
        return way;
    }

    static std::vector<Rung> configuration(const std::vector<Way>& ways) {
        std::vector<Rung> rungs;
        for (const Way& way : ways)
            rungs.push_back({way.axis, way.steps[way.at].technique});
        return rungs;
    }

    // Leaves out what is asked for anyway, or changes nothing.
    std::vector<Rung> shortest(std::vector<Rung> rungs) const {
        const auto plan_of = [&](const std::vector<Rung>& some) {
            frame::FrameOptions options = points_.options();
            for (const Rung& rung : some)
                frame::ask(options, rung.axis, rung.technique);
            return points_.plan(options);
        };
        const auto whole = plan_of(rungs);
        for (std::size_t i = 0; whole && i < rungs.size();) {
            std::vector<Rung> fewer = rungs;
            fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
            const auto plan = plan_of(fewer);
            if (plan && frame::draws_alike(*plan, *whole))
                rungs = std::move(fewer);
            else
                ++i;
        }
        return rungs;
    }

    std::optional<std::size_t> measured(const std::vector<Way>& ways) {
        const auto point = points_.at(shortest(configuration(ways)));
        return point ? std::optional(*point) : std::nullopt;
    }

    // From the cheapest rungs of all axes upwards: the next step is that rung of any axis which, as
    // part of the whole, lowers the error most for its time.
    void climb() {
        std::vector<Way> ways;
        std::size_t steps = 0, done = 0;
        for (const Ladder& ladder : found_.ladders) {
            if (ladder.is_flat()) continue;
            Way way = way_up(ladder);
            if (way.steps.empty()) continue;
            steps += way.steps.size();
            ways.push_back(std::move(way));
        }
        std::optional<std::size_t> now = measured(ways);
        while (now && !stop()) {
            points_.time(*now, how_.seconds_a_point);
            const std::optional<std::size_t> next = best_step(ways, *now);
            if (!next) return;
            now = next;
            tell(0.6 + 0.3 * static_cast<double>(++done) / static_cast<double>(steps));
        }
    }

    // Moves that axis up; returns the point.
    std::optional<std::size_t> best_step(std::vector<Way>& ways, std::size_t now) {
        std::optional<std::size_t> best;
        std::size_t best_way = 0, best_at = 0;
        double most = 0;
        for (std::size_t w = 0; w < ways.size(); ++w) {
            std::vector<Way> tried = ways;
            for (Way& way = tried[w]; ++way.at < way.steps.size();) {
                if (stop()) return std::nullopt;
                const auto point = measured(tried);
                if (!point || !buys(now, *point)) continue;
                points_.time(*point, how_.seconds_a_point);
                const double gain = gain_of(now, *point);
                if (gain > most) {
                    most = gain;
                    best = point;
                    best_way = w;
                    best_at = way.at;
                }
            }
        }
        if (best) ways[best_way].at = best_at;
        return best;
    }

    // Codes for a millisecond; what costs nothing comes first.
    double gain_of(std::size_t from, std::size_t to) const {
        const double least = 0.001 * found_.cpu_ms(from);
        return (found_.error(from) - found_.error(to)) /
               std::max(found_.cpu_ms(to) - found_.cpu_ms(from), least);
    }

    // Neither its time nor its error can be told from what is asked for anyway, which stands for
    // it.
    bool is_as_asked(std::size_t i) const {
        const Difference& ratio = points_[i].price->cpu_ratio;
        return i != 0 && ratio.low <= 1 && ratio.high >= 1 && as_accurate(0, i);
    }

    void draw_frontier() {
        if (!points_.cost()) return;
        std::vector<std::size_t> timed;
        std::vector<TimedError> at;
        for (std::size_t i = 0; i < points_.all().size(); ++i) {
            if (!points_[i].price || is_as_asked(i)) continue;
            timed.push_back(i);
            at.push_back({found_.cpu_ms(i), found_.error(i)});
        }
        const auto time_of = [&](std::size_t point) { return points_[point].price->cpu_ratio; };
        for (const std::size_t i : pareto_set(at)) {
            const std::size_t point = timed[i];
            if (!found_.frontier.empty()) {
                FrontierPoint& last = found_.frontier.back();
                if (!buys(last.point, point)) continue;
                last.ties_with_next = overlap(time_of(last.point), time_of(point));
            }
            found_.frontier.push_back({point, false});
        }
    }

    void look() {
        std::vector<std::size_t> points;
        for (const FrontierPoint& p : found_.frontier)
            points.push_back(p.point);
        for (std::size_t i = 0; how_.flip_of_all && !stopped_ && i < points_.all().size(); ++i)
            points.push_back(i);
        std::sort(points.begin(), points.end());
        points.erase(std::unique(points.begin(), points.end()), points.end());
        points_.look_at(points);
        tell(1);
    }

    Frontier& found_;
    Points& points_;
    const FrontierOptions& how_;
    Stopwatch watch_;
    bool stopped_ = false;
};

} // namespace

Result<Frontier> frontier(const scene::Scene& scene, frame::SceneFacts facts,
                          const scene::View& view, const frame::FrameOptions& options, Jobs& jobs,
                          const image::Image& reference, const FrontierOptions& how) {
    Frontier found;
    TRY(found.points, Points::create(scene, std::move(facts), view, options, jobs, reference));
    Search(found, how).run();
    return found;
}

} // namespace scanout::measure
