// What the viewer shows of accuracy: the picture that converges to the reference, the map of its
// errors, the split view, and their figures. The reference is begun once a picture has stood still,
// and let go as soon as another one is asked for.
#pragma once

#include "app/overlay/overlay.h"
#include "app/picture/composer.h"
#include "app/picture/picture_key.h"
#include "app/view/accuracy_picture.h"
#include "app/view/convergence.h"

#include <optional>
#include <string>

namespace scanout::app {

class AccuracyView {
public:
    using Time = Convergence::Time;

    struct Asked {
        bool converge = false;  // show the reference where it is known
        bool error_map = false; // show the errors instead of the picture
        bool split = false;     // show the reference to the right of split_x
        int split_x = 0;        // pixels
        bool any() const { return converge || error_map || split; }
        friend bool operator==(const Asked&, const Asked&) = default;
    };

    // whole: the reference is shown only when it is finished, as where every run has to show the
    // same.
    explicit AccuracyView(bool whole) : whole_(whole) {}

    // ---- Work --------------------------------------------------------------------------------

    // The picture that should be seen at `now`. Another one than the last time ends the work.
    void follow(const PictureKey& key, Time now);
    void let_go(); // nothing of it is asked for
    void stop();   // the scene is about to change

    // The reference of the picture that is followed is neither finished nor refused.
    bool lacks() const;
    // When there is something to do for it: now, soon (while a thread works), or once the picture
    // has stood still. Only where it lacks.
    Time due(Time now) const;
    // Begins with the reference of the picture that is followed (convergence.h).
    void begin(const scene::Scene& scene, const scene::View& view, const trace::Look& look,
               const PictureKey& key);
    // There will be no reference of the picture that is followed.
    void refuse(const PictureKey& key, const std::string& why);
    bool has_begun() const { return followed_ && begun_ == followed_; }
    Convergence& convergence() { return convergence_; }
    // Takes the progress over into figures and picture, now and then and at the end. drawn: the
    // picture that is followed.
    void refresh(const image::Image& drawn, Time now);

    // ---- What is shown -----------------------------------------------------------------------

    // Grows whenever picture() and the texts have changed.
    int revision() const { return revision_; }
    // The drawn picture, or what is asked for instead as far as the reference of `key` is known.
    // Valid until the next call.
    const image::Image& picture(const image::Image& drawn, const PictureKey& key,
                                const Asked& asked);
    // The reference, once it is finished and all that is shown. Null otherwise.
    const image::Image* finished_picture(const PictureKey& key, const Asked& asked) const;

    // A line for the information panel; empty: nothing is known.
    std::string line(const PictureKey& key, const Asked& asked) const;
    ErrorLegend legend(const image::Image* drawn, const PictureKey& key,
                       const std::optional<PixelPlace>& pointer) const;
    SplitLine split_line(const PictureKey& key, const Asked& asked) const;

private:
    const trace::Progressive* shown(const PictureKey& key) const;
    std::string state(const PictureKey& key) const;

    bool whole_;
    Convergence convergence_;
    std::optional<PictureKey> followed_, begun_; // begun_: that convergence_ is of
    Time still_since_{}, refreshed_{};
    int revision_ = 0;
    bool finished_ = false; // the last refresh was of a finished reference
    std::optional<ErrorFigures> figures_;
    image::Image made_;
    struct Made {
        Asked asked;
        int revision;
        friend bool operator==(const Made&, const Made&) = default;
    };
    std::optional<Made> what_; // made_ is
};

} // namespace scanout::app
