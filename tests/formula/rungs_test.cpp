// docs/anti-aliasing: each rung of anti-aliasing on a zone plate and on a checker board to the
// horizon. `test_formula --gtest_filter='Rungs.*'` with SCANOUT_UPDATE_GOLDEN=1 writes the page and
// its pictures, without it holds them against what is drawn.
#include "formula/formula.h"
#include "frame/catalogue.h"
#include "frame/renderer.h"
#include "image/codec.h"
#include "image/metrics.h"
#include "io/load.h"
#include "io/obj/write_obj.h"
#include "math/srgb.h"
#include "support/shot.h"
#include "support/temporary_folder.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>

namespace scanout::formula {
namespace {

using test::Shot;

const std::string kFolder = SCANOUT_SOURCE_DIR "/docs/anti-aliasing/";

bool updates() {
    const char* value = std::getenv("SCANOUT_UPDATE_GOLDEN");
    return value != nullptr && std::string(value) == "1";
}

void check_file(const std::string& name, const std::string& content) {
    if (updates()) {
        std::filesystem::create_directories(kFolder);
        std::ofstream(kFolder + name, std::ios::binary) << content;
        return;
    }
    std::ifstream stream(kFolder + name, std::ios::binary);
    const std::string kept{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_TRUE(kept == content)
        << name << " is not what is drawn now: SCANOUT_UPDATE_GOLDEN=1 writes it; look at it";
}

// By pixels: another zlib may pack the same picture into other bytes.
void check_picture(const std::string& name, const image::Image& picture) {
    if (updates()) {
        const auto bytes = image::encode_png(picture);
        ASSERT_TRUE(bytes);
        check_file(name, std::string(bytes->begin(), bytes->end()));
        return;
    }
    const auto kept = image::load(kFolder + name);
    ASSERT_TRUE(kept) << name;
    EXPECT_TRUE(*kept == picture)
        << name << " is not what is drawn now: SCANOUT_UPDATE_GOLDEN=1 writes it; look at it";
}

Shot shot_of(const char* name, int width, int height) {
    const Formula& formula = *find_formula(name);
    Jobs jobs(1);
    Wanted wanted;
    wanted.detail = formula.of_model;
    test::TemporaryFolder folder;
    const std::string path =
        folder.write("model.obj", io::obj_text(formula.model(wanted, jobs, {}), {}, {}));
    Warnings warnings;
    auto scene = io::load(path, {}, warnings);
    EXPECT_TRUE(scene);
    Shot s;
    s.name = name;
    s.scene = std::move(*scene);
    s.options.width = width;
    s.options.height = height;
    scene::Light everywhere; // the colours as they are
    everywhere.kind = scene::LightKind::ambient;
    s.options.lights = {everywhere};
    return s;
}

Shot zone_plate() {
    Shot s = shot_of("zone_plate", 240, 240);
    s.camera.projection = scene::Projection::orthographic;
    s.camera.distance = 2.7;
    return s;
}

Shot checker() {
    Shot s = shot_of("checker", 240, 160);
    s.camera.eye = DVec3(0, 1, 1.4);
    s.camera.target = DVec3(0, 0.5, -2.6);
    s.options.background = {150, 190, 230, 255};
    return s;
}

// The mean of 16 x 16 samples at other places than any rung's: each pixel of a picture 16 times as
// large, averaged in linear light.
image::Image converged(Shot s) {
    constexpr int kTimes = 8;
    s.options.width *= kTimes;
    s.options.height *= kTimes;
    s.options.aa = "supersampling_2";
    const image::Image large = test::draw(s);
    image::Image out(large.width() / kTimes, large.height() / kTimes);
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x) {
            DVec3 sum(0);
            for (int k = 0; k < kTimes * kTimes; ++k) {
                const image::Rgba8& p = large.at(kTimes * x + k % kTimes, kTimes * y + k / kTimes);
                sum = sum + DVec3(srgb_decode(p.r), srgb_decode(p.g), srgb_decode(p.b));
            }
            const auto code = [&](double light) {
                return srgb_encode(static_cast<float>(light / (kTimes * kTimes)));
            };
            out.at(x, y) = {code(sum.x), code(sum.y), code(sum.z), 255};
        }
    return out;
}

std::vector<const Technique*> rungs() {
    std::vector<const Technique*> found;
    for (const Technique* t : frame::techniques())
        if (t->axis == "aa") found.push_back(t);
    return found;
}

TEST(Rungs, OfAntiAliasingOnAZonePlateAndACheckerBoard) {
    std::string page =
        "# Anti-aliasing, rung by rung\n\n"
        "A zone plate of 200 rings, which get finer outwards, and a checker board of 128 x 128 "
        "squares from the feet to the horizon: both ask for more detail than pixels can hold, "
        "everywhere, so whatever a rung leaves of it is seen. Rings that are not around the "
        "middle, "
        "and patterns before the horizon, are aliases. Where all detail is finer than a pixel, "
        "grey is right.\n\n"
        "The figure is the root mean square error in codes, against 256 samples a pixel averaged "
        "in "
        "linear light. `tests/formula/rungs_test.cpp` draws the pictures; "
        "`scanout generate zone_plate -o zone_plate.obj` and `scanout generate checker -o "
        "checker.obj` write the models, drawn here with `--light ambient:1`.\n\n"
        "| `--aa` | zone plate | errs | checker board | errs |\n|---|---|---|---|---|\n";
    std::map<std::string_view, std::array<double, 2>> errors;
    std::array<Shot, 2> shots = {zone_plate(), checker()};
    const std::array<image::Image, 2> references = {converged(shots[0]), converged(shots[1])};
    const std::array<std::string, 2> names = {"zone_plate", "checker"};
    const auto row = [&](std::string_view rung, const std::array<std::string, 2>& figures) {
        page += fmt::format("| `{}` | ![zone plate]({}-zone_plate.png) | {} | "
                            "![checker board]({}-checker.png) | {} |\n",
                            rung, rung, figures[0], rung, figures[1]);
    };
    for (const Technique* rung : rungs()) {
        std::array<std::string, 2> figures;
        for (std::size_t i = 0; i < shots.size(); ++i) {
            shots[i].options.aa = std::string(rung->name);
            const image::Image picture = test::draw(shots[i]);
            check_picture(fmt::format("{}-{}.png", rung->name, names[i]), picture);
            errors[rung->name][i] = image::metrics(references[i], picture).rmse_codes;
            figures[i] = fmt::format("{:.1f}", errors[rung->name][i]);
        }
        row(rung->name, figures);
    }
    for (std::size_t i = 0; i < shots.size(); ++i)
        check_picture(fmt::format("256_samples-{}.png", names[i]), references[i]);
    row("256_samples", {"0", "0"});
    check_file("README.md", page);
    for (std::size_t i = 0; i < shots.size(); ++i) {
        EXPECT_LT(errors["samples_4"][i], errors["none"][i]);
        EXPECT_LT(errors["samples_16"][i], errors["samples_4"][i]);
        EXPECT_LT(errors["area"][i], errors["samples_16"][i]);
        EXPECT_LT(errors["supersampling_4"][i], errors["supersampling_2"][i]);
    }
}

} // namespace
} // namespace scanout::formula
