// The help sheet and the file's warnings, on screens of any size: nothing is lost, nothing is cut
// off.
#include "app/overlay/help_sheet.h"
#include "app/overlay/overlay.h"
#include "app/overlay/text_block.h"
#include "app/overlay/warnings_page.h"
#include "app/view/actions.h"

#include <map>
#include <sstream>
#include <utility>

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

struct Screen {
    int width, height;
};
constexpr Screen kScreens[] = {{320, 200},   {640, 480},   {1024, 768}, {1280, 720},
                               {1080, 1920}, {1920, 1080}, {3840, 2160}};

std::vector<HelpPage> pages_on(const Screen& screen) {
    return help_pages(help_sheet({}, KeyMap::standard()),
                      letters_across(screen.width, screen.height),
                      lines_down(screen.width, screen.height));
}

TEST(HelpSheet, HasARowForEachActionThatHasOne) {
    std::map<std::string, int> rows;
    for (const SheetSection& section : help_sheet({}, KeyMap::standard()))
        for (const SheetRow& row : section.rows)
            ++rows[row.keys + "|" + row.text];
    for (const ActionRow& row : action_rows()) {
        const std::string name = std::string(row.sheet) + "|" + std::string(row.help);
        EXPECT_EQ(rows[name], row.sheet.empty() ? 0 : 1) << name;
    }
}

TEST(HelpSheet, SaysThePresentState) {
    const auto now = [](const ViewerState& state, const std::string& keys) {
        for (const SheetSection& section : help_sheet(state, KeyMap::standard()))
            for (const SheetRow& row : section.rows)
                if (row.keys == keys) return row.now;
        return std::string("no such row");
    };
    ViewerState state;
    EXPECT_EQ(now(state, "5"), "perspective");
    EXPECT_EQ(now(state, "B"), "off");
    state.look.projection = scene::Projection::orthographic;
    state.look.annotations.toggle(frame::Annotation::box);
    EXPECT_EQ(now(state, "5"), "orthographic");
    EXPECT_EQ(now(state, "B"), "on");
    EXPECT_EQ(now(state, "G"), "off");
}

TEST(HelpSheet, LosesNoWordOnAnyScreen) {
    for (const Screen& screen : kScreens) {
        std::map<std::string, int> expected, found;
        const auto count = [](std::map<std::string, int>& words, const std::string& text) {
            std::istringstream stream(text);
            for (std::string word; stream >> word;)
                ++words[word];
        };
        for (const SheetSection& section : help_sheet({}, KeyMap::standard())) {
            count(expected, std::string(section.heading));
            for (const SheetRow& row : section.rows)
                count(expected, row.keys + " " + row.text + " " + row.now);
        }
        for (const HelpPage& page : pages_on(screen))
            for (const SheetColumn& column : page.columns)
                for (const SheetLine& line : column.lines)
                    count(found, line.heading + " " + line.keys + " " + line.text + " " + line.now);
        EXPECT_EQ(found, expected) << screen.width;
    }
}

// How many pixels are letters, and how many are panel.
std::pair<int, int> letters_and_panel(const image::Image& picture) {
    int letters = 0, panel = 0;
    for (const image::Rgba8& p : picture.pixels()) {
        letters += p == kBlockText || p == kBlockAccent || p == kBlockDim;
        panel += p == kBlockPanel;
    }
    return {letters, panel};
}

// Letters that were cut off at an edge, or lay under others, would leave fewer pixels than where
// there is more room.
TEST(HelpSheet, IsWhollyWithinThePicture) {
    for (const Screen& screen : kScreens) {
        const int scale = text_scale(screen.width, screen.height);
        for (const HelpPage& page : pages_on(screen)) {
            image::Image picture(screen.width, screen.height, {40, 40, 40, 255}),
                canvas(screen.width + 200, screen.height + 200, {40, 40, 40, 255});
            draw_help(picture, page, scale);
            draw_help(canvas, page, scale);
            EXPECT_EQ(letters_and_panel(picture), letters_and_panel(canvas))
                << screen.width << ' ' << page.footer;
        }
    }
}

TEST(HelpSheet, HasFewPagesWhereThereIsRoomAndSaysWhichOneIsOpen) {
    EXPECT_EQ(pages_on({1280, 720}).size(), 1U);
    EXPECT_EQ(pages_on({1280, 720}).front().footer, "the same key closes");
    EXPECT_LE(pages_on({1920, 1080}).size(), 2U);
    EXPECT_LE(pages_on({3840, 2160}).size(), 2U);
    const std::vector<HelpPage> small = pages_on({320, 200});
    ASSERT_GT(small.size(), 1U);
    EXPECT_EQ(small.front().footer.rfind("page 1 of ", 0), 0U) << small.front().footer;
    EXPECT_NE(small.front().footer.find("the same key goes on"), std::string::npos);
    EXPECT_NE(small.back().footer.find("the same key closes"), std::string::npos);
}

TEST(TextScale, GrowsWithTheHeight) {
    EXPECT_EQ(text_scale(320, 200), 1);
    EXPECT_EQ(text_scale(1280, 720), 1);
    EXPECT_EQ(text_scale(1920, 1080), 2);
    EXPECT_EQ(text_scale(3840, 2160), 4);
    EXPECT_EQ(text_scale(1080, 1920), 3) << "on its side";
    EXPECT_GE(letters_across(1080, 1920), 38U);
}

TEST(WarningsPage, LosesNoWordAndFits) {
    std::vector<std::string> warnings;
    for (int i = 0; i < 30; ++i) {
        std::string text = "model.obj:" + std::to_string(i) + ":";
        for (int k = 0; k < i; ++k)
            text += " w" + std::to_string(i) + "." + std::to_string(k);
        warnings.push_back(text);
    }
    for (const std::size_t letters : {34U, 69U, 140U})
        for (const std::size_t lines : {8U, 28U}) {
            std::string text;
            const std::size_t pages = warnings_page(warnings, letters, lines, 1).pages;
            EXPECT_GT(pages, 1U);
            for (std::size_t page = 1; page <= pages; ++page) {
                const ScreenPage shown = warnings_page(warnings, letters, lines, page);
                EXPECT_LE(shown.lines.size(), lines);
                EXPECT_EQ(shown.lines.front(), "30 warnings of the file");
                for (std::size_t i = 1; i + 1 < shown.lines.size(); ++i) {
                    EXPECT_LE(shown.lines[i].size(), letters);
                    text += shown.lines[i] + " ";
                }
            }
            std::size_t at = 0;
            for (const std::string& warning : warnings) {
                std::istringstream words(warning);
                for (std::string word; words >> word;) {
                    at = text.find(word, at);
                    ASSERT_NE(at, std::string::npos) << word << " on " << letters;
                    at += word.size();
                }
            }
        }
    EXPECT_EQ(warnings_page({}, 34, 8, 1).lines,
              std::vector<std::string>{"the file has no warnings"});
    EXPECT_EQ(warnings_page({"a"}, 34, 8, 1).lines,
              (std::vector<std::string>{"1 warning of the file", "- a", "the same key closes"}));
}

} // namespace
} // namespace scanout::app
