#include "app/lit_sphere.h"
#include "app/view/accuracy_view.h"

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

using namespace std::chrono_literals;
using Time = AccuracyView::Time;

PictureKey key_of(int generation) {
    return picture_key({}, generation);
}

struct Accuracy : ::testing::Test {
    void begin(AccuracyView& view, int generation) {
        view.begin(sphere.scene, sphere.view, sphere.look, key_of(generation));
    }
    // Until there is a reference, none of whose pixels is known.
    void build(AccuracyView& view) {
        while (view.convergence().building())
            std::this_thread::sleep_for(1ms);
        view.convergence().step(jobs, Time::min());
    }
    LitSphere sphere{20, 10};
    Jobs jobs{2};
    image::Image drawn{20, 10, image::Rgba8{9, 9, 9, 255}};
    Time start = Time() + 1h;
};

TEST_F(Accuracy, BeginsOnceThePictureHasStoodStillAndAtOnceWhereItDidAlready) {
    AccuracyView view(false);
    EXPECT_FALSE(view.lacks()) << "nobody asks";
    view.follow(key_of(1), start);
    EXPECT_TRUE(view.lacks());
    EXPECT_LE(view.due(start), start) << "the first picture stands already";
    view.follow(key_of(2), start + 1s);
    EXPECT_EQ(view.due(start + 1s), start + 1500ms);
    view.follow(key_of(2), start + 1200ms);
    EXPECT_EQ(view.due(start + 1200ms), start + 1500ms) << "it has not moved since";
    view.follow(key_of(3), start + 1300ms);
    EXPECT_EQ(view.due(start + 1300ms), start + 1800ms);
    view.let_go();
    EXPECT_FALSE(view.lacks());
}

TEST_F(Accuracy, AnotherPictureEndsTheWorkAndShowsWhatIsDrawn) {
    AccuracyView view(false);
    const AccuracyView::Asked asked{.converge = true};
    view.follow(key_of(1), start);
    begin(view, 1);
    view.convergence().finish(jobs);
    view.refresh(drawn, start);
    EXPECT_FALSE(view.lacks());
    EXPECT_EQ(view.picture(drawn, key_of(1), asked), view.convergence().reference()->image());
    EXPECT_EQ(&view.picture(drawn, key_of(2), asked), &drawn)
        << "the picture has changed, and nobody has said so yet";
    const int revision = view.revision();
    view.follow(key_of(2), start);
    EXPECT_NE(view.revision(), revision);
    EXPECT_TRUE(view.lacks());
    EXPECT_FALSE(view.has_begun());
    EXPECT_EQ(view.convergence().reference(), nullptr);
    EXPECT_EQ(&view.picture(drawn, key_of(2), asked), &drawn);
}

TEST_F(Accuracy, IsRefreshedNowAndThenAndAtTheEnd) {
    AccuracyView view(false);
    view.follow(key_of(1), start);
    begin(view, 1);
    build(view);
    view.refresh(drawn, start);
    const int first = view.revision();
    view.convergence().step(jobs, Time::min());
    view.refresh(drawn, start + 10ms);
    EXPECT_EQ(view.revision(), first);
    view.refresh(drawn, start + 300ms);
    EXPECT_EQ(view.revision(), first + 1);
    view.convergence().finish(jobs);
    view.refresh(drawn, start + 310ms);
    EXPECT_EQ(view.revision(), first + 2);
    view.refresh(drawn, start + 1000ms);
    EXPECT_EQ(view.revision(), first + 2) << "nothing comes any more";
}

// Of a recording: how far it has come is a matter of the clock.
TEST_F(Accuracy, WhereEveryRunMustShowTheSameTheReferenceIsShownWhole) {
    AccuracyView view(true);
    const AccuracyView::Asked asked{.error_map = true};
    view.follow(key_of(1), start);
    begin(view, 1);
    build(view);
    for (int i = 0; i < 10; ++i)
        view.convergence().step(jobs, Time::min());
    const int revision = view.revision();
    view.refresh(drawn, start + 1s);
    EXPECT_EQ(view.revision(), revision) << "no frame is drawn for it";
    EXPECT_EQ(&view.picture(drawn, key_of(1), asked), &drawn);
    EXPECT_EQ(view.line(key_of(1), asked), "");
    view.convergence().finish(jobs);
    view.refresh(drawn, start + 1s);
    EXPECT_NE(&view.picture(drawn, key_of(1), asked), &drawn);
    EXPECT_NE(view.line(key_of(1), asked), "");
}

TEST_F(Accuracy, SaysWhatAPixelErrsHowFarItIsAndWhyThereIsNone) {
    AccuracyView view(false);
    const AccuracyView::Asked asked{.error_map = true};
    const PixelPlace place{10, 5};
    view.follow(key_of(1), start);
    EXPECT_EQ(view.line(key_of(1), asked), "reference: once all stands still");
    begin(view, 1);
    view.convergence().finish(jobs);
    view.refresh(drawn, start);
    const image::Rgba8 q = view.convergence().reference()->image().at(10, 5);
    const int error = std::max({std::abs(q.r - 9), std::abs(q.g - 9), std::abs(q.b - 9)});
    ASSERT_GT(error, 0);
    const std::string title = "error against the reference, codes";
    EXPECT_EQ(view.legend(&drawn, key_of(1), place),
              (ErrorLegend{{title, fmt::format("10,5: {} codes", error),
                            fmt::format("drawn 9 9 9, reference {} {} {}", q.r, q.g, q.b)},
                           true}));
    EXPECT_EQ(view.legend(&drawn, key_of(1), {}), (ErrorLegend{{title, "", ""}, true}));
    EXPECT_NE(view.line(key_of(1), asked).find(" codes RMSE"), std::string::npos);
    EXPECT_NE(view.line(key_of(1), {.converge = true}).find("0.00 on the screen  converged"),
              std::string::npos);
    EXPECT_EQ(view.line(key_of(1), {}), "") << "nothing is asked for";
    view.refuse(key_of(1), "too large");
    EXPECT_FALSE(view.lacks());
    EXPECT_EQ(view.line(key_of(1), asked), "no reference: too large");
    EXPECT_EQ(view.split_line(key_of(1), asked).right, "no reference: too large");
    EXPECT_EQ(view.legend(&drawn, key_of(1), place),
              (ErrorLegend{{"no reference: too large"}, false}))
        << "no map, so no colours";
}

TEST_F(Accuracy, ABuildThatIsLetGoHoldsTheNextOneUpUntilItHasEnded) {
    AccuracyView view(false);
    view.follow(key_of(1), start);
    for (int generation = 1; generation < 50; ++generation) {
        while (!view.convergence().can_begin()) {
            const auto due = view.due(start + 100s);
            const bool could_begin = view.convergence().can_begin(); // else nor could it before
            EXPECT_TRUE(could_begin || due > start + 100s);
            std::this_thread::sleep_for(1ms);
        }
        begin(view, generation);
        view.follow(key_of(generation + 1), start);
    }
    view.stop();
    EXPECT_TRUE(view.convergence().can_begin());
}

TEST_F(Accuracy, ALookThatIsUnknownIsRefused) {
    AccuracyView view(false);
    view.follow(key_of(1), start);
    sphere.look.tone = "no such tone";
    begin(view, 1);
    view.convergence().finish(jobs);
    EXPECT_FALSE(view.lacks());
    EXPECT_NE(view.line(key_of(1), {.converge = true}).find("no such tone"), std::string::npos);
}

} // namespace
} // namespace scanout::app
