// The session's part in frames: what should be seen, how much of it is drawn while something moves,
// and what the display is given.
#include "app/overlay/overlay_text.h"
#include "app/overlay/text.h"
#include "app/picture/picture.h"
#include "app/view/view_session.h"
#include "base/check.h"
#include "base/stopwatch.h"
#include "frame/catalogue.h"

#include <algorithm>
#include <utility>

namespace scanout::app {

// ---- Motion -----------------------------------------------------------------------------------

void ViewSession::set_motion_levels() {
    governor_.reset();
    level_ = 0;
    if (steady_ || !settings_.holds_budget) return;
    set_frame_options();
    levels_ = motion_levels(frame_options_, settings_.named_axes.count("aa") == 0,
                            settings_.named_axes.count("render_scale") == 0);
    std::vector<double> shares;
    for (const MotionLevel& level : levels_)
        shares.push_back(level.share);
    governor_.emplace(std::move(shares), budget_ms());
}

// The level of the next frame: what the governor says until a picture has stood for a while.
void ViewSession::follow_motion(Time now) {
    if (!governor_) return;
    if (settling_.follow(key(), viewer_.turning(), now)) governor_->rest();
    level_ = settling_.moves() ? governor_->level() : 0;
}

// ---- Frames -----------------------------------------------------------------------------------

std::optional<PixelPlace> ViewSession::pointer() const {
    const PointerState& pointer = viewer_.state().pointer;
    if (!pointer.visible || settings_.no_pointer) return std::nullopt;
    return PixelPlace{pointer.x, pointer.y};
}

ViewSession::Shown ViewSession::wanted() {
    const bool draws_pointer = !parts_.display.info().has_pointer;
    return {key(), level_, overlay(), accuracy_.revision(),
            draws_pointer ? pointer() : std::nullopt};
}

Overlay ViewSession::overlay() {
    Overlay overlay = overlay_text(viewer_, slot_, settings_, message_.text(), binder_.keys());
    if (!shows_info()) overlay.info.clear();
    if (viewer_.state().explain > 0) overlay.explain = explain_page().lines;
    if (viewer_.state().warnings > 0) overlay.warnings = warnings().lines;
    if (slot_.model() == nullptr) return overlay;
    if (const auto points = viewer_.measured(); !points.empty()) {
        if (const Result<scene::View> view = viewer_.view(*slot_.mesh()))
            overlay.measured =
                measured_marks(points, *view, *slot_.mesh(), viewer_.width(), viewer_.height());
        if (message_.text().empty() && points.size() > 1)
            overlay.message = fmt::format("{}", fmt::join(measured_text(points), "\n"));
    }
    if (const int hazard = viewer_.state().doctor; hazard > 0) {
        overlay.doctor =
            doctor_.lines(letters_across(viewer_.width(), viewer_.height()), panel_lines(), hazard);
        if (const std::optional<DVec3> place = viewer_.hazard_place())
            overlay.mark = viewer_.pixel_of(*place, *slot_.mesh());
    }
    if (viewer_.state().error_map) overlay.legend = accuracy_.legend(picture_, key(), pointer());
    if (viewer_.state().frontier) overlay.frontier = frontier_panel();
    if (viewer_.state().split) overlay.split = accuracy_.split_line(key(), asked());
    if (const std::string line = accuracy_.line(key(), asked());
        !overlay.info.empty() && !line.empty())
        overlay.info.push_back(line);
    return overlay;
}

void ViewSession::put_asked_frame_options(frame::FrameOptions& out) const {
    out = settings_.frame;
    out.width = background_.width();
    out.height = background_.height();
    out.bits = image::min_bits(parts_.display.info().format);
    out.cull = viewer_.state().look.cull;
    out.annotations = viewer_.state().look.annotations;
    put(viewer_.state().look.rendering, out);
    const auto asked = [](std::string_view axis, const std::string& technique) {
        return technique == frame::first_on(axis) ? "auto" : technique;
    };
    out.colour_by = asked("colour_by", viewer_.state().look.colour_by);
    out.edges = asked("edges", viewer_.state().look.edges);
    viewer_.place_lights(*slot_.mesh(), out.lights);
}

void ViewSession::set_frame_options(int level) {
    put_asked_frame_options(frame_options_);
    if (const measure::KnownPoint* const point = chosen_point())
        for (const measure::Rung& rung : point->rungs)
            if (!counts_before_rung(viewer_.state().look.rendering, rung.axis))
                CHECK(frame::ask(frame_options_, rung.axis, rung.technique));
    if (level == 0) return;
    const MotionLevel& saving = levels_[static_cast<std::size_t>(level)];
    if (saving.one_sample) frame_options_.samples = 1;
    if (!saving.render_scale.empty()) frame_options_.render_scale = saving.render_scale;
}

Result<void> ViewSession::render(int level) {
    follow_section();
    if (const image::Rgba8 colour = viewer_.state().look.rendering.background;
        !(background_.at(0, 0) == colour))
        std::fill(background_.pixels().begin(), background_.pixels().end(), colour);
    if (slot_.model() == nullptr) {
        blank_.reset();
        picture_ = &background_;
        return {};
    }
    const Result<scene::View> view = viewer_.view(*slot_.mesh());
    TRY(const frame::FramePlan* const now, plan(level));
    picture_ = view ? &renderer_.render(slot_.model()->scene, *view, *now) : &background_;
    if (!view)
        blank_ = frame::Blank::outside;
    else if (renderer_.stats().items_shaded == 0)
        blank_ = frame::why_nothing_is_drawn(slot_.model()->scene, *view, *now);
    else
        blank_.reset();
    return {};
}

void ViewSession::compose(const Overlay& overlay, int level) {
    Overlay complete = overlay;
    add_frame_text(complete,
                   {blank_, !steady_, pacer_.frames_per_second(), renderer_.stats(),
                    level > 0 ? levels_[static_cast<std::size_t>(level)].render_scale : ""});
    compose_on(accuracy_.picture(*picture_, key(), asked()), complete);
}

void ViewSession::compose_on(const image::Image& picture, const Overlay& overlay) {
    std::optional<LetterCollector> letters;
    if (parts_.display.info().has_letters) letters.emplace();
    composer_.set_picture(picture, [&](image::Image& out) { draw_overlay(out, overlay); });
    if (letters) parts_.display.show_text(letters->take());
}

Result<void> ViewSession::draw(const Shown& wanted) {
    const bool new_picture =
        picture_ == nullptr || !(wanted.picture == shown_.picture) || wanted.level != shown_.level;
    const Stopwatch watch;
    if (new_picture) TRY_VOID(render(wanted.level));
    if (new_picture || repaint_ || wanted.accuracy != shown_.accuracy ||
        !(wanted.overlay == shown_.overlay))
        compose(wanted.overlay, wanted.level);
    composer_.set_pointer(wanted.pointer);
    TRY_VOID(present());
    if (governor_ && wanted.picture == settling_.picture()) {
        if (new_picture && wanted.level == governor_->level())
            governor_->took(watch.milliseconds());
        if (!(wanted.picture == shown_.picture)) settling_.shown(std::chrono::steady_clock::now());
    }
    shown_ = wanted;
    repaint_ = false;
    if (const auto file = std::exchange(frame_file_, std::nullopt))
        TRY_VOID(log_.dump(displayed(), *file));
    return {};
}

// What the display is given.
const image::Image& ViewSession::displayed() {
    const image::PixelFormat& format = parts_.display.info().format;
    if (!dithers_unasked(settings_, format)) return composer_.frame();
    undithered_ = image::without_dither(format, composer_.frame());
    return undithered_;
}

Result<void> ViewSession::present() {
    const std::vector<image::Rect>& damage = composer_.take_damage();
    const image::Image& image = displayed();
    TRY_VOID(parts_.display.present(image, damage));
    log_.presented(image, renderer_.stats());
    if (parts_.display.ready()) log_.reached(parts_.display.shown_at_ns());
    return {};
}

Result<void> ViewSession::draw_if_due(Time now) {
    if (lost_ || !parts_.display.ready() || !wants_frame()) return {};
    if (!parts_.display.paced() && now < pacer_.due()) return {};
    pacer_.begin_frame(now);
    return draw(wanted());
}

} // namespace scanout::app
