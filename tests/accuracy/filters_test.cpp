// The renderer's filters of a pixel against the reference under the same filter.
#include "accuracy/referenced.h"
#include "image/metrics.h"
#include "support/scenes.h"

namespace scanout::frame {
namespace {

// Codes RMSE: of areas it is what rounding to codes leaves, 0.29 at most, and noise. Tent and
// Gaussian weigh 16 samples of each of nine pixels.
TEST(Filters, DrawWhatTheReferenceDraws) {
    for (const auto& [aa, most] : {std::pair{"area", 0.35}, {"tent", 0.6}, {"gaussian", 0.6}}) {
        test::Shot s = test::solids(aa);
        s.options.aa = aa;
        const trace::Reference reference = test::reference_of(s, {1024});
        const image::Metrics error = image::metrics(reference.image, test::draw(s));
        EXPECT_LT(error.rmse_codes, most) << aa;
        // Another filter draws another picture.
        s.options.aa = std::string_view(aa) == "area" ? "gaussian" : "area";
        const image::Metrics other = image::metrics(reference.image, test::draw(s));
        EXPECT_GT(other.rmse_codes, 2 * error.rmse_codes) << aa;
    }
}

} // namespace
} // namespace scanout::frame
