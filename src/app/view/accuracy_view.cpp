#include "app/view/accuracy_view.h"

#include "image/heat_map.h"

#include <fmt/format.h>

namespace scanout::app {
namespace {

using namespace std::chrono_literals;
constexpr auto kStillness = 500ms; // of a picture, before its reference is begun
constexpr auto kRefresh = 200ms;   // between two looks at the progress
constexpr auto kWaiting = 5ms;     // for a thread

int percent(double share) {
    return static_cast<int>(share * 100);
}

std::string text_of(const image::Rgba8& p) {
    return fmt::format("{} {} {}", p.r, p.g, p.b);
}

} // namespace

void AccuracyView::follow(const PictureKey& key, Time now) {
    if (followed_ == key) return;
    const bool moved = followed_.has_value(); // else it is just now that somebody asks
    let_go();
    followed_ = key;
    still_since_ = moved ? now : now - kStillness;
    figures_.reset();
    finished_ = false;
    what_.reset();
    ++revision_;
}

void AccuracyView::let_go() {
    followed_.reset();
    begun_.reset();
    convergence_.cancel();
}

void AccuracyView::stop() {
    let_go();
    convergence_.stop();
}

void AccuracyView::begin(const scene::Scene& scene, const scene::View& view,
                         const trace::Look& look, const PictureKey& key) {
    convergence_.begin(scene, view, look);
    begun_ = key;
}

void AccuracyView::refuse(const PictureKey& key, const std::string& why) {
    convergence_.refuse(why);
    begun_ = key;
    ++revision_;
}

bool AccuracyView::lacks() const {
    if (!followed_) return false;
    return !has_begun() || (!convergence_.finished() && convergence_.refusal().empty());
}

AccuracyView::Time AccuracyView::due(Time now) const {
    if (has_begun()) return convergence_.building() ? now + kWaiting : now;
    const Time still = still_since_ + kStillness;
    return still > now || convergence_.can_begin() ? still : now + kWaiting;
}

void AccuracyView::refresh(const image::Image& drawn, Time now) {
    const trace::Progressive* const reference = convergence_.reference();
    if (reference == nullptr || finished_) return;
    finished_ = reference->finished();
    if (!finished_ && (whole_ || now - refreshed_ < kRefresh)) return;
    refreshed_ = now;
    figures_ = error_figures(drawn, *reference);
    ++revision_;
}

// As far as it may be seen.
const trace::Progressive* AccuracyView::shown(const PictureKey& key) const {
    if (begun_ != key || (whole_ && !finished_)) return nullptr;
    return convergence_.reference();
}

const image::Image& AccuracyView::picture(const image::Image& drawn, const PictureKey& key,
                                          const Asked& asked) {
    const trace::Progressive* const reference = shown(key);
    if (reference == nullptr || !asked.any()) return drawn;
    if (const image::Image* const all = finished_picture(key, asked)) return *all;
    const Made wanted{asked, revision_};
    if (what_ == wanted) return made_;
    if (asked.error_map)
        error_map(drawn, *reference, made_);
    else if (asked.split) // on its left, the picture as it is drawn
        made_ = drawn;
    else
        converging(drawn, *reference, made_);
    if (asked.split) lay_reference(*reference, asked.split_x, made_);
    what_ = wanted;
    return made_;
}

const image::Image* AccuracyView::finished_picture(const PictureKey& key,
                                                   const Asked& asked) const {
    const trace::Progressive* const reference = shown(key);
    const bool all = asked.converge && !asked.error_map && !asked.split;
    return reference != nullptr && finished_ && all ? &reference->image() : nullptr;
}

std::string AccuracyView::state(const PictureKey& key) const {
    const trace::Progressive* const reference = shown(key);
    if (reference != nullptr)
        return finished_ ? "reference" : fmt::format("reference {} %", percent(reference->share()));
    if (begun_ != key) return "reference: once all stands still";
    if (!convergence_.refusal().empty()) return "no reference: " + convergence_.refusal();
    return "reference: is being made";
}

std::string AccuracyView::line(const PictureKey& key, const Asked& asked) const {
    if (!asked.any()) return {};
    const trace::Progressive* const reference = shown(key);
    if (reference == nullptr || !figures_) return whole_ ? std::string() : state(key);
    std::string text = fmt::format("error {:.2f} codes RMSE", figures_->drawn);
    const bool converging = asked.converge && !asked.error_map && !asked.split;
    if (converging) text += fmt::format(", {:.2f} on the screen", figures_->converging);
    if (finished_) return text + (converging ? "  converged" : "");
    return text + fmt::format("  {} % {}", percent(reference->share()),
                              converging ? "converged" : "of the reference");
}

ErrorLegend AccuracyView::legend(const image::Image* drawn, const PictureKey& key,
                                 const std::optional<PixelPlace>& pointer) const {
    const trace::Progressive* const reference = shown(key);
    if (reference == nullptr || drawn == nullptr) return {{state(key)}, false};
    const std::string title = "error against the reference, codes";
    const std::string progress = finished_ ? "" : state(key);
    if (!pointer) return {{title, progress, ""}, true};
    const std::string place = fmt::format("{},{}: ", pointer->x, pointer->y);
    if (reference->known(pointer->y * drawn->width() + pointer->x) == trace::Known::nothing)
        return {{title, place + "not known yet", progress}, true};
    const image::Rgba8 &p = drawn->at(pointer->x, pointer->y),
                       &q = reference->image().at(pointer->x, pointer->y);
    return {{title, fmt::format("{}{} codes", place, image::largest_difference(p, q)),
             fmt::format("drawn {}, reference {}", text_of(p), text_of(q))},
            true};
}

SplitLine AccuracyView::split_line(const PictureKey& key, const Asked& asked) const {
    return {asked.split_x, asked.error_map ? "errors" : "now", state(key)};
}

} // namespace scanout::app
