// The promise of the same bits everywhere: frame hashes of generated scenes, kept in hashes.txt and
// equal for every compiler, thread count and machine. SCANOUT_UPDATE_GOLDEN=1 writes them anew.
#include "base/write_file.h"
#include "image/hash.h"
#include "support/scenes.h"

#include <cstdlib>
#include <fstream>
#include <map>
#include <set>

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
            s.options.samples = samples;
            if (s.name == "samples_8") continue;
            if (s.name == "lines_and_points" && samples > 1) continue; // whole pixels: no change
            s.name += "_x" + std::to_string(samples);
            shots.push_back(s);
        }
    }
    shots.push_back(soup("soup", 3000, 0.8, 1));
    shots.push_back(soup("soup_around_the_eye", 500, 6, 2));
    shots.push_back(soup("soup_mirrored_and_squeezed", 500, 0.8, 3));
    shots.back().model.scale = {-1, 0.25, 3};
    shots.back().model.rotate_degrees = {12, 34, 56};
    shots.back().options.samples = 8;
    shots.push_back(solids("zoomed_a_thousandfold"));
    shots.back().pose.zoom = 10 * scene::kZoomLevelsPerOctave;
    shots.back().options.samples = 16;
    return shots;
}

std::map<std::string, std::string> kept() {
    std::map<std::string, std::string> table;
    std::ifstream in(kTable);
    for (std::string hash, name; in >> hash >> name;)
        table[name] = hash;
    return table;
}

TEST(Hashes, AreThoseInTheRepositoryAtEveryThreadCount) {
    std::map<std::string, std::string> got;
    std::set<std::string> different;
    for (const Shot& s : hashed_shots()) {
        const std::string hash = image::hash_text(image::frame_hash(draw(s)));
        for (const int threads : {2, 3, 7, 16})
            EXPECT_EQ(image::hash_text(image::frame_hash(draw(s, threads))), hash)
                << s.name << " on " << threads << " threads";
        ASSERT_TRUE(got.emplace(s.name, hash).second) << s.name << " twice";
        different.insert(hash);
    }
    EXPECT_EQ(different.size(), got.size()) << "two scenes look alike";
    EXPECT_GE(got.size(), 12U);
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

} // namespace
} // namespace scanout::test
