// The promise of the same bits everywhere (HARD-CASES P8, rows 65 and 69): hashes of colour, depth
// and id of generated scenes, kept in hashes.txt and equal for every SIMD target, thread count,
// tile size, compiler and machine. SCANOUT_UPDATE_GOLDEN=1 writes them anew.
#include "base/write_file.h"
#include "image/hash.h"
#include "simd/targets.h"
#include "support/scenes.h"

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <set>

#include <xxhash.h>

namespace scanout::test {
namespace {

const std::string kTable = std::string(SCANOUT_SOURCE_DIR) + "/tests/golden/hashes.txt";

// The golden scenes at an odd size with one and four samples, and some that only hashes can hold.
std::vector<Shot> hashed_shots() {
    std::vector<Shot> shots;
    for (const int samples : {1, 4}) {
        for (Shot s : golden_shots()) {
            s.options.width = 257;
            s.options.height = 131;
            // With a line along every outline, four samples resolve nothing: a sample of the pixel
            // beside the line's is as far from their border as from the middle along the line, and
            // so the outline, whose slope is at most 1, passes it on the far side. Eight do.
            const bool covered = s.name == "lines_on_faces" || s.name == "edges_all";
            s.options.samples = samples > 1 && covered ? 8 : samples;
            // At this size adaptive interpolation is exact.
            if (s.name == "samples_8" || s.name == "interpolate_perspective") continue;
            if (s.name == "cull_material") continue; // cull_back: its one material has one side
            // A number of samples is said above; the others have their own.
            if (s.options.aa != "auto" &&
                (samples > 1 || s.options.aa == "none" || s.options.aa.starts_with("samples")))
                continue;
            if (s.options.blend_space != "auto" && samples == 1) continue; // nothing is mixed
            if (s.options.stencil == "overdraw" && samples > 1) continue;  // counts at centres
            if (s.name == "lines_and_points" && samples > 1) continue; // whole pixels: no change
            s.name += "_x" + std::to_string(s.options.samples);
            shots.push_back(s);
        }
    }
    shots.push_back(soup("soup", 3000, 0.8, 1));
    shots.push_back(textured_cube("adaptive_cube", "bilinear"));
    shots.back().camera.fov_degrees = 12; // steps of some length
    shots.back().options.interpolate = "adaptive";
    shots.back().options.width = 257;
    shots.back().options.height = 131;
    shots.push_back(soup("soup_by_area", 300, 0.8, 5)); // planes cross, triangles are cut
    shots.back().camera.eye = DVec3(0, 0, 0.5);
    shots.back().camera.target = DVec3(0, 0, 0);
    shots.back().options.aa = "area";
    shots.push_back(near_clip("near_clip_by_area"));
    shots.back().options.aa = "area";
    shots.push_back(soup("soup_under_a_tent", 500, 0.8, 6));
    shots.back().options.aa = "tent";
    shots.back().options.dither = "bayer";
    shots.push_back(soup("soup_around_the_eye", 500, 6, 2));
    shots.push_back(soup("soup_mirrored_and_squeezed", 500, 0.8, 3));
    shots.back().model.scale = {-1, 0.25, 3};
    shots.back().model.rotate_degrees = {12, 34, 56};
    shots.back().options.samples = 8;
    shots.push_back(soup("crowd_around_the_eye", 20000, 6, 4)); // several chunks of geometry
    shots.back().options.samples = 2;
    shots.push_back(solids("zoomed_a_thousandfold"));
    shots.back().pose.zoom = 10 * scene::kZoomLevelsPerOctave;
    shots.back().options.samples = 16;
    return shots;
}

using Table = std::map<std::string, std::string>; // name -> colour, depth, id

Table kept() {
    Table table;
    std::ifstream in(kTable);
    for (std::string colour, depth, id, name; in >> colour >> depth >> id >> name;)
        table[name] = colour + ' ' + depth + ' ' + id;
    return table;
}

template <class T>
std::string hash_of(const std::vector<T>& values) {
    return image::hash_text(XXH64(values.data(), values.size() * sizeof(T), 0));
}

std::string hashes(const Shot& s, int threads, int tile_size) {
    frame::Visibility seen;
    const image::Image picture =
        draw(s, {.threads = threads, .tile_size = tile_size, .visibility = &seen});
    return image::hash_text(image::frame_hash(picture)) + ' ' + hash_of(seen.depth) + ' ' +
           hash_of(seen.id);
}

// Every test leaves the best target chosen.
class Hashes : public testing::Test {
protected:
    void TearDown() override { EXPECT_TRUE(simd::choose_target("auto")); }
};

TEST_F(Hashes, AreThoseInTheRepository) {
    Table got;
    std::set<std::string> different;
    std::cout << "drawn on " << simd::chosen_target() << '\n'; // read by tests/avx3
    for (const Shot& s : hashed_shots()) {
        ASSERT_TRUE(got.emplace(s.name, hashes(s, 1, 64)).second) << s.name << " twice";
        // In an empty buffer nothing is equal: as with never, nothing is seen.
        different.insert(s.options.depth_test == "equal" ? s.name : got[s.name]);
    }
    EXPECT_EQ(different.size(), got.size()) << "two scenes look alike";
    std::set<std::string> pictures; // that samples are resolved shows in colours alone
    for (const auto& [name, hash] : got)
        EXPECT_TRUE(name.starts_with("depth_") || pictures.insert(hash.substr(0, 16)).second)
            << name;
    EXPECT_GE(got.size(), 20U);
    const char* update = std::getenv("SCANOUT_UPDATE_GOLDEN");
    if (update != nullptr && std::string(update) == "1") {
        std::string text;
        for (const auto& [name, hash] : got)
            text += hash + " " + name + "\n";
        const auto written = write_file(kTable, text);
        ASSERT_TRUE(written) << written.error().what;
    }
    EXPECT_EQ(got, kept());
}

TEST_F(Hashes, AreTheSameOnEveryTargetAndThreadCount) {
    const Table table = kept();
    int targets = 0;
    for (const simd::Target& target : simd::targets()) {
        if (!target.supported) continue;
        ASSERT_TRUE(simd::choose_target(target.name));
        ++targets;
        for (const Shot& s : hashed_shots())
            for (const int threads : {1, 2, 3, 7, 16})
                EXPECT_EQ(hashes(s, threads, 64), table.at(s.name))
                    << s.name << " on " << target.name << " with " << threads << " threads";
    }
    // Sanitized builds hold one target; they look for what threads do.
    EXPECT_GE(targets, simd::targets().size() > 1 ? 2 : 1) << "nothing to compare with";
    RecordProperty("targets", targets);
}

TEST_F(Hashes, AreTheSameForEveryTileSize) {
    const Table table = kept();
    for (const simd::Target& target : simd::targets()) {
        if (!target.supported) continue;
        ASSERT_TRUE(simd::choose_target(target.name));
        for (const Shot& s : hashed_shots())
            for (const int tile_size : {8, 16, 32})
                EXPECT_EQ(hashes(s, 2, tile_size), table.at(s.name))
                    << s.name << " on " << target.name << " in tiles of " << tile_size;
    }
}

// Skipped, and counted as such, where nothing above was drawn on one of them.
TEST_F(Hashes, WereComparedOnEveryTargetOfTheProgram) {
    std::string lacking;
    for (const simd::Target& target : simd::targets())
        if (!target.supported) lacking += ' ' + target.name;
    if (!lacking.empty())
        GTEST_SKIP() << "this CPU lacks" << lacking << ": no hash was compared there";
}

} // namespace
} // namespace scanout::test
