#include "app/view/bindings.h"
#include "app/view/recording.h"
#include "base/mapping.h"
#include "support/temporary_folder.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::app {
namespace {

std::string error_of(const std::string& text) {
    const Result<Script> script = parse_script(text, "a.txt");
    if (script) return "(no error)";
    EXPECT_EQ(script.error().exit, Exit::unreadable);
    EXPECT_EQ(script.error().what.find('\n'), std::string::npos);
    return script.error().what;
}

RC_GTEST_PROP(Recording, WhatIsRecordedIsReadBackTheSame, ()) {
    const test::TemporaryFolder folder;
    Script script;
    std::int64_t step = 0;
    for (int i = *rc::gen::inRange(0, 40); i > 0; --i) {
        const ActionRow& row = action_rows()[static_cast<std::size_t>(
            *rc::gen::inRange<int>(0, action_rows().size()))];
        Action action{row.id, {}, {}, *rc::gen::arbitrary<bool>()};
        for (int n = 0; n < row.numbers; ++n)
            action.numbers[static_cast<std::size_t>(n)] = *rc::gen::arbitrary<int>();
        if (row.id == ActionId::frame) action.text = "a name.png";
        step += *rc::gen::inRange(0, 1000);
        script.push_back({step, action});
    }
    Result<Recorder> recorder = Recorder::create(folder.file("r.txt"));
    RC_ASSERT(recorder.has_value());
    for (const TimedAction& action : script)
        RC_ASSERT(recorder->write(action).has_value());
    // The recorder still lives: each line is in the file as soon as it is written.
    const Result<Script> read = load_script(folder.file("r.txt"));
    RC_ASSERT(read.has_value());
    RC_ASSERT(*read == script);
}

TEST(Recording, StepsAreAbsoluteRelativeOrLeftOut) {
    const Result<Script> script = parse_script("scanout-actions 1\r\n"
                                               "# by hand\n"
                                               "\n"
                                               "  5   rotate_left\r\n"
                                               "rotate_right\n"
                                               "+10 frame my picture.png\n"
                                               "20 quit",
                                               "a.txt");
    ASSERT_TRUE(script) << script.error().what;
    ASSERT_EQ(script->size(), 4U);
    EXPECT_EQ((*script)[1].step, 5);
    EXPECT_EQ((*script)[2].step, 15);
    EXPECT_EQ((*script)[2].action.text, "my picture.png");
    EXPECT_EQ((*script)[3].step, 20);
}

// Where the error sends the reader.
TEST(Recording, TheListAndTheGuideNameEveryAction) {
    const Mapping guide = *Mapping::open(SCANOUT_SOURCE_DIR "/docs/GUIDE.md");
    const std::string_view text = guide.text();
    const std::string list = keys_text();
    for (const ActionRow& row : action_rows()) {
        const std::string name(row.name);
        EXPECT_NE(list.find(" " + name + " "), std::string::npos) << name;
        if (!row.keys.empty()) continue;
        EXPECT_NE(text.find("| `" + name), std::string_view::npos) << name << " has no key";
    }
}

// The block of the guide, as it stands there.
TEST(Recording, TheGuidesExampleIsARecording) {
    const Mapping guide = *Mapping::open(SCANOUT_SOURCE_DIR "/docs/GUIDE.md");
    const std::string_view text = guide.text();
    const std::size_t begin = text.find("scanout-actions 1");
    ASSERT_NE(begin, std::string_view::npos);
    const Result<Script> script =
        parse_script(text.substr(begin, text.find("```", begin) - begin), "guide");
    ASSERT_TRUE(script) << script.error().what;
    EXPECT_GT(script->size(), 4U);
    EXPECT_EQ(script->back().action.id, ActionId::quit);
}

TEST(Recording, ErrorsNameTheLineAndWhatIsWrong) {
    EXPECT_NE(error_of("").find("a.txt: is empty"), std::string::npos);
    EXPECT_NE(error_of("rotate_left\n").find("a.txt:1: "), std::string::npos);
    EXPECT_NE(error_of("scanout-actions 2\n").find("scanout-actions 1"), std::string::npos);
    const std::string head = "scanout-actions 1\n";
    EXPECT_EQ(error_of(head + "0 rotate_lefft\n"),
              "a.txt:2: there is no action 'rotate_lefft'; did you mean 'rotate_left'?");
    EXPECT_EQ(error_of(head + "0 move_pointer 1 2\n"),
              "a.txt:2: there is no action 'move_pointer'; did you mean 'pointer'?");
    EXPECT_EQ(error_of(head + "0 fly\n"),
              "a.txt:2: there is no action 'fly'; `scanout list keys` names them, docs/GUIDE.md "
              "explains them");
    EXPECT_NE(error_of(head + "5 quit\n4 quit\n").find("a.txt:3: "), std::string::npos);
    EXPECT_NE(error_of(head + "drag_rotate 1\n").find("2 whole numbers"), std::string::npos);
    EXPECT_NE(error_of(head + "drag_rotate 1 2.5\n").find("2 whole numbers"), std::string::npos);
    EXPECT_NE(error_of(head + "drag_rotate 1 99999999999\n").find("2 whole numbers"),
              std::string::npos);
    EXPECT_NE(error_of(head + "quit now\n").find("'now'"), std::string::npos);
    EXPECT_NE(error_of(head + "frame\n").find("file name"), std::string::npos);
    EXPECT_EQ(error_of(head + "0 frame a.png\n3 frame x.gif\n"),
              "a.txt:3: frame x.gif: the name must end in .png, .ppm, .pam or .raw");
    EXPECT_NE(error_of(head + "frame -\n").find("must end in"), std::string::npos);
    EXPECT_NE(error_of(head + "7\n").find("missing"), std::string::npos);
    EXPECT_NE(error_of(head + "+ quit\n").find("+30"), std::string::npos);
    EXPECT_NE(error_of(head + "99999999999999999999999 quit\n").find("too large"),
              std::string::npos);
}

RC_GTEST_PROP(Recording, AnyTextIsReadOrRefused, (const std::string& text)) {
    (void)parse_script(text, "a.txt");
    (void)parse_script("scanout-actions 1\n" + text, "a.txt");
}

TEST(Recording, AFileThatCannotBeWrittenOrReadIsAnError) {
    EXPECT_FALSE(Recorder::create("/nonexistent/r.txt"));
    EXPECT_FALSE(load_script("/nonexistent/r.txt"));
}

} // namespace
} // namespace scanout::app
