// Bytes of a terminal -> tokens, answers and events.
#include "platform/tty/answers.h"
#include "platform/tty/mouse.h"
#include "platform/tty/parser.h"
#include "platform/tty/paste.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::tty {
namespace {

using testing::ElementsAre;
using Kind = Token::Kind;

std::vector<Token> tokens_of(std::string_view bytes) {
    Parser parser;
    std::vector<Token> tokens;
    parser.feed(bytes, tokens);
    return tokens;
}

TEST(Parser, TellsKeysSequencesAndStringsApart) {
    EXPECT_THAT(
        tokens_of("q\x1b[A\x1bOP\x1b[<0;3;4M\x1b_Gi=31;OK\x1b\\\x1bP1$r0m\x1b\\\x1b]11;x\ax"),
        ElementsAre(Token{Kind::keys, "q"}, Token{Kind::sequence, "A"}, Token{Kind::keys, "\x1bOP"},
                    Token{Kind::sequence, "<0;3;4M"}, Token{Kind::string, "_Gi=31;OK"},
                    Token{Kind::string, "P1$r0m"}, Token{Kind::string, "]11;x"},
                    Token{Kind::keys, "x"}));
    EXPECT_THAT(tokens_of("\x1b\x1b[A\x1bx\x1b[[A"),
                ElementsAre(Token{Kind::keys, "\x1b"}, Token{Kind::sequence, "A"},
                            Token{Kind::keys, "\x1bx"}, Token{Kind::keys, "\x1b[[A"}));
}

TEST(Parser, WaitsForTheRestOfASequenceAndLongerForAnAnswer) {
    Parser parser;
    std::vector<Token> tokens;
    EXPECT_EQ(parser.patience_ms(), 0);
    parser.feed("\x1b", tokens);
    EXPECT_TRUE(tokens.empty());
    EXPECT_GE(parser.patience_ms(), 150) << "an arrow in two packets is no Escape";
    EXPECT_LE(parser.patience_ms(), 200);
    parser.give_up(tokens);
    EXPECT_THAT(tokens, ElementsAre(Token{Kind::keys, "\x1b"})) << "the Escape key";
    tokens.clear();
    parser.feed("\x1bP", tokens);
    parser.give_up(tokens);
    EXPECT_THAT(tokens, ElementsAre(Token{Kind::keys, "\x1bP"})) << "Alt-P begins no string";
    tokens.clear();
    parser.feed("\x1b[?62;", tokens);
    EXPECT_EQ(parser.patience_ms(), 1000);
    parser.give_up(tokens);
    EXPECT_TRUE(tokens.empty()) << "half an answer is no key";
    EXPECT_EQ(parser.patience_ms(), 0);
}

TEST(Parser, SaysWhenATokenBeginsSoThatWhatFollowsDoesNotPutItsEndOff) {
    Parser parser;
    std::vector<Token> tokens;
    EXPECT_FALSE(parser.feed("q", tokens)) << "it is whole";
    EXPECT_TRUE(parser.feed("\x1b_", tokens));
    EXPECT_FALSE(parser.feed("Gi=31", tokens));
    EXPECT_FALSE(parser.feed(";O", tokens));
    EXPECT_TRUE(parser.feed("K\x1b\\\x1b[", tokens)) << "another one";
    EXPECT_FALSE(parser.feed("A", tokens));
}

TEST(Parser, AnEndlessStringIsThrownAway) {
    Parser parser;
    std::vector<Token> tokens;
    for (int i = 0; i < 1000; ++i)
        parser.feed("\x1b]aaaaaaaaaa", tokens);
    parser.feed(std::string(5000, 'a'), tokens);
    EXPECT_LE(parser.patience_ms(), 1000);
    parser.feed("\x1b\\q", tokens);
    EXPECT_EQ(tokens.back(), (Token{Kind::keys, "q"}));
}

RC_GTEST_PROP(Parser, it_does_not_matter_where_reads_cut, ()) {
    const std::vector<std::string> pieces{"q",     "\x1b[A",  "\x1b[<0;3;4M", "\x1b_Gi=1;OK\x1b\\",
                                          "\x1bx", "\x1bOA",  "\x1b[?62;4c",  "\x1bP1$r48;2m\x1b\\",
                                          "\x7f",  "\x1b[[B", "\xc3\xa4",     "\x1b[200~"};
    std::string bytes;
    for (const int i : *rc::gen::container<std::vector<int>>(
             rc::gen::inRange(0, static_cast<int>(pieces.size()))))
        bytes += pieces[static_cast<std::size_t>(i)];
    Parser parser;
    std::vector<Token> tokens;
    for (std::size_t at = 0; at < bytes.size();) {
        const auto length = *rc::gen::inRange<std::size_t>(1, 6);
        parser.feed(std::string_view(bytes).substr(at, length), tokens);
        at += length;
    }
    RC_ASSERT(tokens == tokens_of(bytes));
    RC_ASSERT(parser.patience_ms() == 0);
}

RC_GTEST_PROP(Parser, any_bytes_end_and_lose_no_key_behind_them, (const std::string& bytes)) {
    Parser parser;
    std::vector<Token> tokens;
    parser.feed(bytes, tokens);
    parser.give_up(tokens);
    parser.feed("q", tokens);
    RC_ASSERT(!tokens.empty());
    RC_ASSERT(tokens.back() == (Token{Kind::keys, "q"}));
}

Facts facts_of(std::string_view bytes) {
    Facts facts;
    for (const Token& token : tokens_of(bytes))
        take_answer(token, facts);
    return facts;
}

TEST(Answers, AreTakenAsTheTerminalGivesThem) {
    EXPECT_EQ(facts_of("\x1b[?62;22c"), (Facts{.answers = true}));
    EXPECT_EQ(facts_of("\x1b[?62;4;22c"), (Facts{.answers = true, .sixel = true}));
    EXPECT_EQ(facts_of("\x1b[?14;64c"), (Facts{.answers = true})) << "4 is a number of its own";
    EXPECT_EQ(facts_of("\x1b_Gi=31;OK\x1b\\"), (Facts{.kitty = true}));
    EXPECT_EQ(facts_of("\x1b_Gi=31;ENOTSUPPORTED:no\x1b\\"), Facts());
    EXPECT_EQ(facts_of("\x1b[6;20;9t"), (Facts{.cell_width = 9, .cell_height = 20}));
    EXPECT_EQ(facts_of("\x1b[6;0;9t\x1b[6;99999;9t\x1b[4;600;800t"), Facts());
    EXPECT_EQ(facts_of("\x1b[?1016;2$y\x1b[?2026;1$y"),
              (Facts{.pixel_mouse = true, .synchronized = true}));
    EXPECT_EQ(facts_of("\x1b[?1016;0$y\x1b[?2026;4$y"), Facts()) << "not known, never on";
    EXPECT_EQ(facts_of("\x1bP1$r0;48:2::1:2:3m\x1b\\"), (Facts{.true_colour = true}));
    EXPECT_EQ(facts_of("\x1bP1$r48;2;1;2;3m\x1b\\"), (Facts{.true_colour = true}));
    EXPECT_EQ(facts_of("\x1bP1$r48;5;16m\x1b\\\x1bP0$r\x1b\\"), Facts()) << "an index";
    EXPECT_EQ(facts_of("\x1b[?1;0;1024S"), (Facts{.colour_registers = 1024}));
    EXPECT_EQ(facts_of("\x1b[?1;3;0S"), Facts()) << "a failure";
}

TEST(Answers, APictureIsToldFromTheQuestionAndFromKeys) {
    Facts facts;
    EXPECT_EQ(take_answer({Kind::string, "_Gi=77;OK"}, facts), Answer::picture);
    EXPECT_EQ(take_answer({Kind::string, "_Gi=77;ENOSPC:full"}, facts), Answer::refusal);
    EXPECT_EQ(refusal_of({Kind::string, "_Gi=77;ENOSPC:full\x1b[2J"}), "ENOSPC:full?[2J");
    EXPECT_EQ(refusal_of({Kind::string, "_Gi=77"}), "an error");
    EXPECT_EQ(facts, Facts());
    EXPECT_FALSE(facts.kitty);
    EXPECT_EQ(take_answer({Kind::string, "_Gi=31;OK"}, facts), Answer::fact);
    EXPECT_EQ(take_answer({Kind::sequence, "?62c"}, facts), Answer::attributes);
    for (const char* key : {"A", "1;2A", "5~", "1;2S", "<0;1;1M", "c"})
        EXPECT_EQ(take_answer({Kind::sequence, key}, facts), Answer::none) << key;
    EXPECT_EQ(take_answer({Kind::keys, "q"}, facts), Answer::none);
}

TEST(Answers, WhatGoesThroughTmuxHasItsEscapesDoubled) {
    EXPECT_EQ(through_tmux("\x1b_Ga;b\x1b\\"), "\x1bPtmux;\x1b\x1b_Ga;b\x1b\x1b\\\x1b\\");
}

TEST(Paste, IsNoKeysUpToItsEndOrASilence) {
    using std::chrono::milliseconds;
    const Token begin{Kind::sequence, "200~"}, end{Kind::sequence, "201~"}, key{Kind::keys, "q"};
    Paste paste;
    Paste::Time now = std::chrono::steady_clock::now();
    EXPECT_FALSE(paste.has(key, now));
    EXPECT_TRUE(paste.has(begin, now));
    for (int i = 0; i < 100; ++i)
        EXPECT_TRUE(paste.has(key, now += milliseconds(900))) << "a long one on a slow line";
    EXPECT_TRUE(paste.has(end, now));
    EXPECT_FALSE(paste.has(key, now)) << "right behind it";
    EXPECT_TRUE(paste.has(begin, now));
    EXPECT_TRUE(paste.has(key, now));
    EXPECT_FALSE(paste.has(key, now += milliseconds(1100))) << "the end was lost";
    EXPECT_FALSE(paste.has(key, now));
    EXPECT_TRUE(paste.has(begin, now));
    EXPECT_FALSE(paste.has({Kind::keys, "\x03"}, now)) << "Ctrl-C always ends the viewer";
}

TEST(Mouse, ButtonsMotionAndWheelBecomeEvents) {
    std::vector<port::Event> events;
    add_mouse("<4;41;7M", 80, 24, 0.5, events);
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].kind, port::EventKind::motion_absolute);
    EXPECT_DOUBLE_EQ(events[0].x, 40.5 / 80);
    EXPECT_DOUBLE_EQ(events[0].y, 6.5 / 24);
    EXPECT_EQ(events[1].kind, port::EventKind::button);
    EXPECT_EQ(events[1].button, port::Button::left);
    EXPECT_TRUE(events[1].pressed && events[1].shift && !events[1].control);
    events.clear();
    add_mouse("<18;999;999m", 80, 24, 0.5, events);
    EXPECT_EQ(events[0].x, 1) << "cut to the picture";
    EXPECT_EQ(events[1].button, port::Button::right);
    EXPECT_TRUE(!events[1].pressed && events[1].control);
    events.clear();
    add_mouse("<35;3;4M", 80, 24, 0.5, events);
    EXPECT_EQ(events.size(), 1U) << "motion alone";
    events.clear();
    add_mouse("<65;3;4M", 80, 24, 0.5, events);
    EXPECT_EQ(events[1].scroll, 120) << "towards the user";
    add_mouse("<64;3;4M", 80, 24, 0.5, events);
    EXPECT_EQ(events[3].scroll, -120);
    events.clear();
    add_mouse("<66;3;4M", 80, 24, 0.5, events);
    EXPECT_EQ(events.size(), 1U) << "a wheel to the side";
    for (const char* broken : {"<M", "<1;2M", "<a;b;cM", "<99999999999999;1;1M"})
        add_mouse(broken, 80, 24, 0.5, events);
    EXPECT_EQ(events.size(), 1U);
}

} // namespace
} // namespace scanout::tty
