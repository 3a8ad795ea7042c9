// Files that change while they are shown: what inotify tells of them, and the viewer with --watch.
#include "app/session_fixture.h"
#include "app/view/file_watch.h"

#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace scanout::app {
namespace {

TEST(FileWatch, TellsOfItsFilesWrittenOrPutInTheirPlaceAndOfNoOthers) {
    const test::TemporaryFolder folder, other;
    const std::string path = folder.write("part.stl", "1");
    auto watch = FileWatch::create();
    ASSERT_TRUE(watch);
    watch->watch({path, folder.file("later.mtl"), "/no/such/folder/x.obj"});
    EXPECT_FALSE(watch->take_changes());
    folder.write("part.stl", "2");
    EXPECT_TRUE(watch->take_changes());
    EXPECT_FALSE(watch->take_changes()) << "once";
    folder.write("beside.stl", "1");
    EXPECT_FALSE(watch->take_changes());
    std::rename(folder.file("beside.stl").c_str(), path.c_str());
    EXPECT_TRUE(watch->take_changes());
    folder.write("later.mtl", "1");
    EXPECT_TRUE(watch->take_changes()) << "it was not there before";

    watch->watch({other.file("model.obj")});
    folder.write("part.stl", "3");
    EXPECT_FALSE(watch->take_changes()) << "no longer watched";
    other.write("model.obj", "1");
    EXPECT_TRUE(watch->take_changes());
}

// Does something at each of its times, then quits.
class ActingInput final : public port::Input {
public:
    ActingInput(std::vector<std::function<void()>> acts, std::chrono::milliseconds pause)
        : acts_(std::move(acts)), timed_([&] {
              std::vector<TimedInput::Entry> entries(acts_.size(), {pause, {}});
              entries.push_back({pause, {quit()}});
              return entries;
          }()) {}
    int event_fd() const override { return timed_.event_fd(); }
    Result<void> dispatch(std::vector<port::Event>& events) override {
        if (next_ < acts_.size()) acts_[next_]();
        ++next_;
        return timed_.dispatch(events);
    }
    std::string description() const override { return "acting"; }

private:
    std::vector<std::function<void()>> acts_;
    TimedInput timed_;
    std::size_t next_ = 0;
};

struct WatchSession : Session {
    WatchSession() { settings.watch = true; }
    // What is on the display after each act, and at the end.
    std::vector<image::Image> shown_after(const std::vector<std::function<void()>>& acts) {
        port::HeadlessDisplay display = make_display();
        std::vector<image::Image> shown;
        std::vector<std::function<void()>> looking;
        for (const auto& act : acts)
            looking.emplace_back([&, act] {
                shown.push_back(display.shown());
                act();
            });
        ActingInput input(looking, 1000ms);
        auto session = ViewSession::create(settings, {display, input, jobs, {}, {}, {}, false});
        EXPECT_TRUE((*session)->run());
        shown.push_back(display.shown());
        return shown;
    }
};

TEST_F(WatchSession, ShowsAFileAsItIsAfterItWasWrittenAnew) {
    const image::Image cube = rendered({});
    const auto shown = shown_after({[&] { folder.write("beside.obj", "v 0 0 0\n"); },
                                    [&] {
                                        folder.write("new.obj", "v 0 0 0\nv 1 0 0\nv 0 3 0\n"
                                                                "f 1 2 3\n");
                                        std::rename(folder.file("new.obj").c_str(),
                                                    folder.file("cube.obj").c_str());
                                    }});
    const image::Image triangle = rendered({});
    ASSERT_NE(cube, triangle);
    ASSERT_EQ(shown.size(), 3U);
    EXPECT_EQ(shown[0], cube);
    EXPECT_EQ(shown[1], cube) << "another file";
    EXPECT_EQ(shown[2], with_message(triangle, "read again: " + folder.file("cube.obj")));
}

TEST_F(WatchSession, ShowsAModelWhoseMaterialsWereWrittenAnew) {
    folder.write("m.mtl", "newmtl m\nKd 1 0 0\n");
    folder.write("cube.obj", "mtllib m.mtl\nusemtl m\n" + std::string(kCube));
    const image::Image red = rendered({});
    const auto shown = shown_after({[&] { folder.write("m.mtl", "newmtl m\nKd 0 1 0\n"); }});
    const image::Image green = rendered({});
    ASSERT_NE(red, green);
    EXPECT_EQ(shown[0], red);
    EXPECT_EQ(shown[1], with_message(green, "read again: " + folder.file("cube.obj")));
}

TEST_F(WatchSession, WaitsForAFileThatIsNotThereYet) {
    settings.arguments = {folder.file("later.obj")};
    const auto shown = shown_after({[&] { folder.write("later.obj", kCube); }});
    EXPECT_EQ(shown[1], with_message(rendered({}), "read again: " + folder.file("later.obj")));
    EXPECT_NE(shown[0], shown[1]);
}

TEST_F(WatchSession, SleepsWhereNothingIsWritten) {
    double before = 0, after = 0;
    shown_after({[&] { before = cpu_seconds(); }, [&] { after = cpu_seconds(); }});
#ifndef SCANOUT_SANITIZED // ThreadSanitizer has a thread of its own, which does not sleep
    EXPECT_LT(after - before, 0.1) << "a second of waiting";
#endif
}

} // namespace
} // namespace scanout::app
