// Holds a frame budget while something moves: picks the level of quality of the next frame from the
// times of those before. It knows no clock and draws nothing.
//
// Levels are ordered, the best first, each with the share of the work that it leaves. A frame is
// thought to take a + b share, and what a step changes tells a from b. After two frames in a row
// over the budget it goes down to the first level that is thought to fit; where a step down gains
// nothing it goes back, for then the levels cannot help. After a while of frames that leave room
// for the level above it goes up by one; where that has to be taken back, the next try waits twice
// as long, so that levels do not alternate.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

namespace scanout::app {

class Governor {
public:
    // shares: of each level, 1 first and falling; at least one. budget_ms: of a frame; 0: none.
    Governor(std::vector<double> shares, double budget_ms);

    int level() const { return level_; } // of the next frame; 0: the best
    // A frame of level() took so long.
    void took(double ms);
    // All is still. The next motion begins at the last level that held the budget.
    void rest();

private:
    double share(int level) const { return shares_[static_cast<std::size_t>(level)]; }
    double thought(double ms, int to) const; // of a frame that takes ms at the present level
    void go(int level, double ms);
    void learn(double ms);

    std::vector<double> shares_;
    double budget_ms_;
    double fixed_ = 0; // the share of a best frame that no level saves: a / (a + b)
    int level_ = 0;
    int least_;    // no level below it helps, until all is still
    int patience_; // frames that leave room before a step up

    struct Step { // the one to the present level
        int from = 0;
        double ms = 0; // of a frame there
    };
    std::optional<Step> step_;
    bool held_ = true; // the present level has held the budget, or was not entered from below
    // Frames of the present level, all of them or those in a row at the end.
    int frames_ = 0, over_ = 0, within_ = 0, roomy_ = 0;
    double quickest_ms_ = INFINITY, least_over_ms_ = 0; // of all; of those in a row over the budget
};

} // namespace scanout::app
