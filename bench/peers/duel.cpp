#include "bench/peers/duel.h"

#include "base/write_file.h"
#include "bench/peers/first_frame.h"
#include "bench/peers/floor.h"
#include "bench/peers/machine.h"
#include "bench/peers/pictures.h"
#include "image/codec.h"

#include <algorithm>
#include <array>

namespace scanout::bench {
namespace {

constexpr int kBatch = 5, kWarm = 2;
constexpr int kProcesses = 7; // that draw a first frame
constexpr int kMaxCores = 8; // that are asked which is the quietest

// The views that are compared, in twelfths of a turn.
constexpr std::array kCompared = {10, 7, 4, 1};

Result<void> save(const PicturePair& pair, const Load& load, int twelfth,
                  const std::string& folder) {
    std::string name(load.name);
    std::replace(name.begin(), name.end(), ' ', '-');
    for (const auto& [picture, side] :
         {std::pair(&pair.ours, "scanout"), {&pair.theirs, "llvmpipe"}}) {
        TRY(const image::Bytes png, image::encode_png(*picture));
        TRY_VOID(write_file(fmt::format("{}/{}.{}.{}.png", folder, name, twelfth * 30, side), png));
    }
    return {};
}

// Stays on the core where both sides together draw fastest at present: a neighbour that shares a
// core's caches takes a third from both, but not the same from each.
Result<void> choose_core(Ours& ours, Theirs& theirs, const scene::View& view) {
    int best = 0;
    double least = 0;
    for (int core = 0; core < std::min(cores(), kMaxCores); ++core) {
        stay_on_one_core(core);
        Times both;
        Result<void> drawn;
        for (int i = 0; i < kWarm + 1; ++i) {
            both.add([&] {
                theirs.draw(view);
                drawn = ours.draw(view);
            });
            TRY_VOID(drawn);
        }
        if (core > 0 && both.cpu_least() >= least) continue;
        best = core;
        least = both.cpu_least();
    }
    stay_on_one_core(best);
    return {};
}

// Of the view where they differ most.
Result<Difference> compare(Ours& ours, Theirs& theirs, const Load& load, const scene::Scene& scene,
                           const DuelOptions& o) {
    Difference worst;
    for (const int twelfth : kCompared) {
        TRY(const scene::View view, view_of(load, scene, twelfth, 12, o.width, o.height));
        theirs.draw(view);
        TRY_VOID(ours.draw(view));
        const PicturePair pair = pictures_of(ours, theirs, load, view);
        worst = worse(worst, difference(pair, kBackground));
        if (!o.save_in.empty()) TRY_VOID(save(pair, load, twelfth, o.save_in));
    }
    return worst;
}

} // namespace

Result<Duel> duel(const Load& load, const scene::Scene& scene, const DuelOptions& o) {
    Duel result;
    Jobs jobs(1);
    TRY(const scene::View start, view_of(load, scene, 0, o.frames, o.width, o.height));
    Ours ours(jobs, scene, load, o.width, o.height);
    TRY(Theirs theirs, Theirs::create(scene, load, o.width, o.height, o.placed));
    Result<void> drawn;
    std::vector<double> first;
    int processes = o.first_frame.empty() ? kProcesses : 0;
    const auto draw_first = [&] {
        if (processes == kProcesses) return;
        ++processes;
        const Result<double> ratio = first_of_process(o.first_frame);
        if (ratio)
            first.push_back(*ratio);
        else
            fmt::print(stderr, "{}: {}\n", load.name, ratio.error().what);
    };
    CoreMeter core;
    TRY_VOID(choose_core(ours, theirs, start));
    for (int begin = 0; begin < o.frames; begin += kBatch) {
        std::vector<scene::View> views;
        for (int i = begin; i < std::min(o.frames, begin + kBatch); ++i) {
            TRY(const scene::View view, view_of(load, scene, i, o.frames, o.width, o.height));
            views.push_back(view);
        }
        // A side's first frame of a turn finds what the other has left in the caches: in a viewer
        // one frame follows the other, so it does not count.
        theirs.draw(views.back());
        for (const scene::View& view : views)
            result.theirs.add([&] { theirs.draw(view); });
        TRY_VOID(ours.draw(views.back()));
        for (const scene::View& view : views) {
            result.ours.add([&] { drawn = ours.draw(view); });
            TRY_VOID(drawn);
        }
        // In these turns, so that an hour's slow minutes meet what is measured as they meet the
        // frames. Neither leaves anything in the caches.
        draw_first();
        core.measure();
    }
    for (int i = 0; i < kProcesses; ++i) // of which there were fewer turns
        draw_first();
    for (int quarter = 0; quarter < 4; ++quarter) {
        TRY(const scene::View view, view_of(load, scene, quarter, 4, o.width, o.height));
        result.fragments += theirs.fragments(view) / 4;
    }
    TRY(result.difference, compare(ours, theirs, load, scene, o));
    result.first = measure::median(first);
    result.vertices = scene.mesh.position.size();
    result.triangles = scene.mesh.triangles();
    result.drawn = ours.triangles_drawn();
    result.core = core.typical();
    result.floor = floor_of(load,
                            {result.vertices, result.triangles, static_cast<double>(result.drawn),
                             result.fragments, static_cast<double>(o.width) * o.height},
                            result.core);
    return result;
}

} // namespace scanout::bench
