#include "fake_card.h"
#include "platform/drm/choose.h"
#include "platform/drm/open.h"

#include <optional>

#include <gtest/gtest.h>

namespace scanout::drm {
namespace {

struct Case {
    std::string name;
    std::vector<FakeCard*> cards;
    std::string chosen;               // the display's name begins so, or empty: refused
    std::vector<std::string> reasons; // in the refusal, in this order
};

Result<std::unique_ptr<KmsDisplay>> open_cards(const std::vector<FakeCard*>& cards,
                                               const Options& options, const console::Seat& seat) {
    std::vector<std::string> paths;
    for (std::size_t i = 0; i < cards.size(); ++i)
        paths.push_back(fmt::format("/dev/dri/card{}", i));
    const OpenCard open = [&](const std::string& path) -> Result<std::unique_ptr<Device>> {
        FakeCard* card = cards[static_cast<std::size_t>(path.back() - '0')];
        if (card == nullptr)
            return fail(Exit::no_display, "Permission denied: add the user to group video");
        return std::make_unique<FakeDevice>(*card);
    };
    return open_first(paths, open, options, seat);
}

TEST(ChooseCard, TakesTheFirstThatCanShowSomethingAndSaysWhyTheOthersCannot) {
    FakeCard good, render_only, unplugged, taken, no_dumb;
    render_only.failing = "connectors";
    render_only.error = EOPNOTSUPP;
    unplugged.connectors = {connector_of(1, "HDMI-A-1", false)};
    taken.failing = "take_master";
    taken.error = EBUSY;
    no_dumb.dumb_buffers = false;
    const std::vector<Case> cases{
        {"one", {&good}, "DRM card0 Virtual-1 (fake)", {}},
        {"render only first", {&render_only, &good}, "DRM card1", {}},
        {"unplugged first", {&unplugged, &good}, "DRM card1", {}},
        {"taken first", {&taken, &good}, "DRM card1", {}},
        {"denied first", {nullptr, &good}, "DRM card1", {}},
        {"none", {}, "", {"there is no /dev/dri/card*"}},
        {"all refused",
         {nullptr, &render_only, &unplugged, &taken, &no_dumb},
         "",
         {"/dev/dri/card0: Permission denied: add the user to group video",
          "/dev/dri/card1: no mode setting", "/dev/dri/card2: no connected connector",
          "/dev/dri/card3: another program draws there",
          "/dev/dri/card4: the driver fake has no dumb buffers"}},
    };
    for (const Case& test : cases) {
        const TestSeat seat;
        const auto display = open_cards(test.cards, {}, seat);
        ASSERT_EQ(display.has_value(), !test.chosen.empty()) << test.name;
        if (display) {
            EXPECT_TRUE((*display)->info().name.starts_with(test.chosen))
                << (*display)->info().name;
            continue;
        }
        EXPECT_EQ(display.error().exit, Exit::no_display);
        std::size_t at = 0;
        for (const std::string& reason : test.reasons) {
            at = display.error().what.find(reason, at);
            EXPECT_NE(at, std::string::npos) << reason << " in: " << display.error().what;
        }
    }
    for (const FakeCard* card : {&good, &render_only, &unplugged, &taken, &no_dumb})
        EXPECT_TRUE(card->everything_freed());
}

TEST(ChooseCard, AModeThatIsNoModeIsAUsageErrorAtOnce) {
    FakeCard a, b;
    const TestSeat seat;
    for (const char* mode :
         {"big", "640", "640x", "x480", "640x480@", "640x480@x", "640x480@-1", "640x480p"}) {
        const auto display = open_cards({&a, &b}, {"", "", mode}, seat);
        ASSERT_FALSE(display) << mode;
        EXPECT_EQ(display.error().exit, Exit::usage) << mode;
    }
}

TEST(ChooseMode, ThePreferredModeElseTheMostPixelsThenTheHighestRefresh) {
    Connector connector;
    connector.name = "HDMI-A-1";
    connector.modes = {mode_of(640, 480, 60), mode_of(1920, 1080, 50), mode_of(1920, 1080, 60),
                       mode_of(800, 600, 75)};
    EXPECT_EQ(choose_mode(connector, "")->vrefresh, 60U);
    EXPECT_EQ(choose_mode(connector, "")->hdisplay, 1920);
    connector.modes.push_back(mode_of(1280, 1024, 60, true));
    EXPECT_EQ(choose_mode(connector, "")->hdisplay, 1280);
    EXPECT_EQ(choose_mode(connector, "1920x1080")->vrefresh, 60U);
    EXPECT_EQ(choose_mode(connector, "1920x1080@50")->vrefresh, 50U);
    EXPECT_EQ(choose_mode(connector, "1920x1080@59.94")->vrefresh, 60U);
    const auto missing = choose_mode(connector, "1920x1080@75");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().what,
              "HDMI-A-1 has no mode 1920x1080@75 (there is: 640x480@60 1920x1080@50 1920x1080@60 "
              "800x600@75 1280x1024@60)");
    EXPECT_EQ(choose_mode(connector, "preferred")->hdisplay, 1280);
    EXPECT_EQ(choose_mode(connector, "highest")->hdisplay, 1920);
    EXPECT_EQ(choose_mode(connector, "highest")->vrefresh, 60U);
}

TEST(ChooseMode, RefreshCountsTheWholeFrameWithItsBlanking) {
    drmModeModeInfo mode{};
    mode.clock = 148500; // 1920x1080 as televisions have it
    mode.htotal = 2200;
    mode.vtotal = 1125;
    mode.vrefresh = 59;
    EXPECT_EQ(refresh_hz(mode), 60.0);
    mode.flags = DRM_MODE_FLAG_INTERLACE;
    EXPECT_EQ(refresh_hz(mode), 120.0);
    mode.clock = 0;
    EXPECT_EQ(refresh_hz(mode), 59.0);
}

TEST(ChooseConnector, ByNameOrTheFirstConnectedOne) {
    FakeCard card;
    card.connectors = {connector_of(1, "VGA-1", false), connector_of(2, "HDMI-A-1"),
                       connector_of(3, "DP-1")};
    FakeDevice device(card);
    EXPECT_EQ(choose(device, {})->connector.name, "HDMI-A-1");
    EXPECT_EQ(choose(device, {"", "DP-1", ""})->connector.name, "DP-1");
    EXPECT_EQ(choose(device, {"", "VGA-1", ""}).error().what,
              "connector VGA-1 has no display connected: plug one in, or leave --connector out");
    EXPECT_EQ(choose(device, {"", "DP-7", ""}).error().what,
              "no connector DP-7 (there is: VGA-1 HDMI-A-1 DP-1)");
    card.connectors = {connector_of(2, "HDMI-A-1")};
    card.connectors[0].modes.clear();
    EXPECT_FALSE(choose(device, {})) << "a connector without modes shows nothing";
}

TEST(ChooseCrtc, LeavesTheCrtcOfAnotherDisplayToItUnlessThereIsNoOther) {
    FakeCard card;
    card.connectors = {connector_of(1, "HDMI-A-1"), connector_of(2, "DP-1")};
    card.connectors[0].crtcs = {50};
    card.connectors[1].crtcs = {50, 51};
    FakeDevice device(card);
    EXPECT_EQ(choose(device, {"", "DP-1", ""})->crtc, 51U);
    card.connectors[1].crtcs = {50};
    EXPECT_EQ(choose(device, {"", "DP-1", ""})->crtc, 50U);
    card.connectors[1].crtcs = {};
    EXPECT_EQ(choose(device, {"", "DP-1", ""}).error().what,
              "connector DP-1: no CRTC can drive it");
}

} // namespace
} // namespace scanout::drm
