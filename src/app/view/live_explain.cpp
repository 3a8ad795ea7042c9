#include "app/view/live_explain.h"

#include <utility>

namespace scanout::app {

void LiveExplain::begin(std::unique_ptr<measure::Explainer> explainer, const PictureKey& key) {
    explainer_ = std::move(explainer);
    key_ = key;
}

void LiveExplain::measure() {
    explainer_->step();
}

bool LiveExplain::has_all_rows(const PictureKey& key) const {
    return explains(key) && explainer_->finished();
}

ScreenPage LiveExplain::page(std::size_t letters, std::size_t lines, std::size_t page) const {
    return screen_table(explainer_->so_far(), explainer_->rows_done(), letters, lines, page);
}

} // namespace scanout::app
