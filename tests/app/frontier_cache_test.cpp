#include "app/frontier/cache.h"
#include "app/frontier/key.h"
#include "app/options/options.h"
#include "support/temporary_folder.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace scanout::app {
namespace {

const std::string kKey = "scene 0123456789abcdef\nsize 64x48\n";

measure::KnownFrontier frontier() {
    return {"2026-11-29",
            {{{{"aa", "none"}, {"texture", "nearest"}}, 1.0 / 3, 0.5, 4.75},
             {{}, 2.5, 5, 2},
             {{{"aa", "area"}}, 1234.5, 2345, 0.125}}};
}

TEST(FrontierCache, WhatIsKeptIsFound) {
    const test::TemporaryFolder folder;
    const FrontierCache cache(folder.file("new/scanout"));
    EXPECT_FALSE(cache.find(kKey));
    const Result<void> kept = cache.keep(kKey, frontier());
    ASSERT_TRUE(kept) << kept.error().what;
    const auto found = cache.find(kKey);
    ASSERT_TRUE(found);
    EXPECT_EQ(*found, frontier()) << "every bit of every number";
    EXPECT_FALSE(cache.find(kKey + "threads 2\n"));
    ASSERT_TRUE(cache.keep(kKey, {"2027-01-01", {{{}, 1, 1, 1}}}));
    EXPECT_EQ(cache.find(kKey)->date, "2027-01-01");
    EXPECT_TRUE(cache.find(kKey)->complete);
    ASSERT_TRUE(cache.keep(kKey, {"2027-01-02", {{{}, 1, 1, 1}}, false}));
    EXPECT_EQ(cache.find(kKey)->date, "2027-01-02");
    EXPECT_FALSE(cache.find(kKey)->complete);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.file("new/scanout")), {}),
              1);
}

TEST(FrontierCache, AFileOfAnotherKeyIsMissing) {
    EXPECT_TRUE(parse_frontier(to_text(kKey, frontier()), kKey));
    EXPECT_FALSE(parse_frontier(to_text("scene 0\n" + kKey, frontier()), kKey));
    EXPECT_FALSE(parse_frontier(to_text(kKey + "more\n", frontier()), kKey));
}

// Each byte that is changed, left out or added makes the file count as missing.
TEST(FrontierCache, DamageIsSeen) {
    const std::string text = to_text(kKey, frontier());
    for (std::size_t i = 0; i < text.size(); ++i) {
        std::string damaged = text;
        damaged[i] = static_cast<char>(damaged[i] ^ 1);
        EXPECT_FALSE(parse_frontier(damaged, kKey)) << i;
        EXPECT_FALSE(parse_frontier(text.substr(0, i), kKey)) << i;
        EXPECT_FALSE(parse_frontier(text.substr(0, i) + "5" + text.substr(i), kKey)) << i;
    }
    EXPECT_FALSE(parse_frontier(text + "\n", kKey));
    EXPECT_FALSE(parse_frontier("", kKey));
}

// With a right hash: of another version of the program, or written by hand.
TEST(FrontierCache, WhatIsNoFrontierCountsAsMissing) {
    const auto parsed = [](std::string what, std::string by) {
        std::string text = to_text(kKey, frontier());
        const std::size_t at = text.find(what);
        EXPECT_NE(at, std::string::npos) << what;
        text.replace(at, what.size(), by);
        // Lines that stand behind the date become part of it in a text made anew.
        const std::size_t date = text.find("measured ") + 9;
        const measure::KnownFrontier none{text.substr(date, text.rfind("hash ") - 1 - date), {}};
        return parse_frontier(to_text(kKey, none), kKey);
    };
    EXPECT_TRUE(parsed("point", "point"));
    EXPECT_FALSE(parsed("aa=area", "aa=magic"));
    EXPECT_FALSE(parsed("aa=area", "tone=filmic")) << "a model is no rung";
    EXPECT_FALSE(parsed("aa=area", "area"));
    EXPECT_FALSE(parsed("1234.5", "-1234.5"));
    EXPECT_FALSE(parsed("1234.5", "inf"));
    EXPECT_FALSE(parsed("1234.5", "nan"));
    EXPECT_FALSE(parsed("1234.5", "1234.5x"));
    EXPECT_FALSE(parsed("1234.5 2345 0.125", "1234.5 2345"));
    EXPECT_FALSE(parsed("point", "pint"));
    EXPECT_FALSE(parse_frontier(to_text(kKey, {"2026-11-29", {}}), kKey)) << "no point";
}

TEST(FrontierCache, WhatCannotBeWrittenIsAnErrorThatNamesIt) {
    const test::TemporaryFolder folder;
    const std::string file = folder.write("file", "");
    const Result<void> kept = FrontierCache(file + "/scanout").keep(kKey, frontier());
    ASSERT_FALSE(kept);
    EXPECT_EQ(kept.error().what, file + "/scanout: cannot be made: Not a directory; set "
                                        "XDG_CACHE_HOME to a folder that can be written");
    const FrontierCache cache(folder.file("")); // a folder stands where the file should
    ASSERT_EQ(::mkdir(cache.file_of(kKey).c_str(), 0700), 0);
    EXPECT_EQ(cache.keep(kKey, frontier()).error().what,
              cache.file_of(kKey) + ": stands in the cache and is no regular file; remove it");
    EXPECT_FALSE(cache.find(kKey));
}

TEST(FrontierCache, TheNewestFilesAreKept) {
    namespace fs = std::filesystem;
    const test::TemporaryFolder folder;
    const FrontierCache cache(folder.file("scanout"));
    const std::size_t most = FrontierCache::kMostFiles;
    const auto now = fs::file_time_type::clock::now();
    const auto key = [](std::size_t i) { return kKey + std::to_string(i) + "\n"; };
    for (std::size_t i = 0; i < most; ++i) { // the last is the oldest
        ASSERT_TRUE(cache.keep(key(i), frontier()));
        fs::last_write_time(cache.file_of(key(i)), now - std::chrono::hours(i + 1));
    }
    folder.write("scanout/mine", "another program's");
    fs::last_write_time(folder.file("scanout/mine"), now - std::chrono::hours(9999));
    ASSERT_TRUE(cache.keep(kKey, frontier()));
    EXPECT_TRUE(cache.find(kKey));
    EXPECT_TRUE(cache.find(key(0)));
    EXPECT_TRUE(cache.find(key(most - 2)));
    EXPECT_FALSE(fs::exists(cache.file_of(key(most - 1))));
    EXPECT_TRUE(fs::exists(folder.file("scanout/mine")));
}

// Nobody reads from it: whoever opens it to write waits.
TEST(FrontierCache, APipeInPlaceOfTheFileIsRefusedAtOnce) {
    const test::TemporaryFolder folder;
    const FrontierCache cache(folder.file(""));
    ASSERT_EQ(::mkfifo(cache.file_of(kKey).c_str(), 0600), 0);
    ::alarm(10);
    const Result<void> kept = cache.keep(kKey, frontier());
    EXPECT_FALSE(cache.find(kKey));
    ::alarm(0);
    ASSERT_FALSE(kept);
    EXPECT_NE(kept.error().what.find("no regular file"), std::string::npos) << kept.error().what;
}

TEST(FrontierCache, StandsWhereTheUsersCachesAre) {
    const std::string home = std::getenv("HOME") != nullptr ? std::getenv("HOME") : "";
    const auto file = [] {
        const auto cache = FrontierCache::of_user();
        return cache ? cache->file_of(kKey) : cache.error().what;
    };
    ::setenv("HOME", "/home/user", 1);
    ::setenv("XDG_CACHE_HOME", "/caches", 1);
    EXPECT_TRUE(file().starts_with("/caches/scanout/")) << file();
    ::setenv("XDG_CACHE_HOME", "relative", 1);
    EXPECT_TRUE(file().starts_with("/home/user/.cache/scanout/")) << file();
    ::unsetenv("XDG_CACHE_HOME");
    EXPECT_TRUE(file().starts_with("/home/user/.cache/scanout/")) << file();
    ::unsetenv("HOME");
    EXPECT_FALSE(FrontierCache::of_user());
    ::setenv("HOME", home.c_str(), 1);
}

std::string key_of(const Settings& s, const scene::View& view = {}, std::uint64_t content = 1,
                   int threads = 2) {
    return frontier_key(content, view, s.frame, {"aa"}, threads);
}

// Whatever an option changes in FrameOptions is in the key, but for names of lights.
TEST(FrontierKey, EachOptionOfThePictureChangesIt) {
    const std::map<std::string_view, std::string_view> values = {
        {"size", "320x200"},         {"background", "white"},  {"effect", "shadow=off"},
        {"shadow-plane", "0,1,0,0"}, {"light", "point:1,2,3"}, {"alpha-cut", "0.25"},
        {"exposure", "1"},           {"shadow-size", "512"},   {"shadow-filter", "5"},
        {"edge-angle", "40"},        {"line-width", "2"},      {"point-size", "3"},
        {"annotate", "box"}};
    std::set<std::string> keys = {key_of({})};
    int options_tried = 0;
    for (const Option& option : options()) {
        if (option.group != Group::picture || !belongs(option, Command::render)) continue;
        // Others are of what draws instead, or are drawn over the finished picture.
        if (!belongs(option, Command::frontier) || option.name == "reference-samples") continue;
        Settings s;
        const auto value = values.find(option.name);
        const std::string_view last = option.choices.substr(option.choices.rfind(' ') + 1);
        const std::string_view text = value != values.end()     ? value->second
                                      : !option.choices.empty() ? last
                                                                : "none";
        ASSERT_TRUE(apply(option, text, s)) << option.name;
        ASSERT_FALSE(s.frame == Settings().frame) << option.name;
        EXPECT_TRUE(keys.insert(key_of(s)).second || option.name == "samples" ||
                    option.name == "aa")
            << option.name;
        ++options_tried;
    }
    EXPECT_GT(options_tried, 25);
    EXPECT_EQ(keys.count(key_of({})), 1U);
}

TEST(FrontierKey, DependsOnSceneViewAxesThreadsAndBits) {
    scene::View turned;
    turned.linear[0][1] = 1e-15;
    scene::View wider;
    wider.half_width = 1.5;
    Settings bits;
    bits.frame.bits = 5;
    const std::set<std::string> keys = {
        key_of({}),
        key_of({}, turned),
        key_of({}, wider),
        key_of({}, {}, 2),
        key_of({}, {}, 1, 3),
        key_of(bits),
        frontier_key(1, {}, frame::FrameOptions(), {"aa", "texture"}, 2)};
    EXPECT_EQ(keys.size(), 7U);
    for (const char* name : {"scene ", "processor ", "program ", "target "})
        EXPECT_NE(key_of({}).find(name), std::string::npos) << name;
}

} // namespace
} // namespace scanout::app
