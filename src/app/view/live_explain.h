// The plan of what is on show with figures: what each effect costs and changes. The figures of a
// row take several frames, so they are found out one row at a time, while nothing else happens.
#pragma once

#include "app/picture/picture_key.h"
#include "app/report/explain_report.h"
#include "measure/explain.h"

#include <memory>

namespace scanout::app {

class LiveExplain {
public:
    // Begins anew, for the picture that `key` names.
    void begin(std::unique_ptr<measure::Explainer> explainer, const PictureKey& key);
    // Goes on with the figures of a row: a few frames.
    void measure();
    void stop() { explainer_.reset(); }

    bool explains(const PictureKey& key) const { return explainer_ != nullptr && key == key_; }
    // All rows of this picture have their figures.
    bool has_all_rows(const PictureKey& key) const;
    // The figures found so far. Only of a picture that it explains.
    ScreenPage page(std::size_t letters, std::size_t lines, std::size_t page) const;

private:
    std::unique_ptr<measure::Explainer> explainer_;
    PictureKey key_;
};

} // namespace scanout::app
