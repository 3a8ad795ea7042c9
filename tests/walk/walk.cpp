// walk HOW_LONG SEED SCRATCH FOLDER...: draws random frames of the models in the folders, and of
// some that it writes to SCRATCH, and checks what must hold of each (laws.h). HOW_LONG is a number
// of rounds, the same ones on every machine, or a time: "600s". A frame is drawn in a process of
// its own kin, so one that ends by a signal is a finding like any other. What breaks a law is
// printed as a command line to paste. `walk 0 SEED:ROUND SCRATCH FOLDER...` does one round again.
#include "io/load.h"
#include "math/bits.h"
#include "walk/command.h"
#include "walk/laws.h"
#include "walk/models.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

namespace scanout::test {
namespace {

constexpr std::uintmax_t kMaxBytes = 350'000; // of a model's file
// Of processor time, whatever else the machine does; and of any, where a round waits for ever.
constexpr unsigned kSecondsARound = 60, kSecondsAtMost = 900;
constexpr int kMaxFindings = 20;

// What the parent learns of its child, however that ends.
struct Shared {
    std::uint64_t round = 0; // the one that is on its way
    int findings = 0;
    std::uint64_t drawn = 0, refused = 0;
};

class Walk {
public:
    Walk(std::uint64_t seed, const std::vector<std::filesystem::path>& folders) : seed_(seed) {
        for (const std::filesystem::path& folder : folders)
            for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
                if (entry.path().extension() == ".obj" && entry.file_size() <= kMaxBytes)
                    load(entry.path());
        std::sort(models_.begin(), models_.end(),
                  [](const WalkModel& a, const WalkModel& b) { return a.path < b.path; });
    }
    std::size_t models() const { return models_.size(); }

    std::vector<std::string> command(std::uint64_t round) const {
        Random random = random_of(round);
        const WalkModel& model = models_[model_of(random)];
        return maker_.make(place_of(model), random);
    }
    Verdict check(std::uint64_t round) const {
        Random random = random_of(round);
        const WalkModel& model = models_[model_of(random)];
        const std::vector<std::string> arguments = maker_.make(place_of(model), random);
        return judge(arguments, model, random);
    }
    std::uint64_t seed() const { return seed_; }

private:
    void load(const std::filesystem::path& path) {
        Warnings warnings;
        auto scene = io::load(path.string(), {}, warnings);
        if (scene) models_.push_back({std::move(*scene), path.string()});
    }
    Random random_of(std::uint64_t round) const { return Random((seed_ << 32) ^ round); }
    std::size_t model_of(Random& random) const {
        return static_cast<std::size_t>(random.whole(0, static_cast<int>(models_.size()) - 1));
    }
    static ModelPlace place_of(const WalkModel& model) {
        const geom::Mesh& mesh = model.scene.mesh;
        return {model.path, mesh.centre, scanout::scale(mesh.radius, mesh.exponent)};
    }
    std::uint64_t seed_;
    std::vector<WalkModel> models_;
    CommandMaker maker_;
};

void tell(const Walk& walk, std::uint64_t round, const std::string& what) {
    fmt::print("{}:{}: {}\n    {}\n", walk.seed(), round, what, shell_line(walk.command(round)));
    std::fflush(stdout);
}

void do_round(const Walk& walk, Shared& shared) {
    ::itimerval limit{};
    limit.it_value.tv_sec = kSecondsARound;
    ::setitimer(ITIMER_PROF, &limit, nullptr);
    ::alarm(kSecondsAtMost);
    const Verdict verdict = walk.check(shared.round);
    for (const std::string& fault : verdict.faults)
        tell(walk, shared.round, fault);
    shared.findings += verdict.faults.empty() ? 0 : 1;
    ++(verdict.outcome == Outcome::refused ? shared.refused : shared.drawn);
}

using Clock = std::chrono::steady_clock;

// So many rounds, or as many as there is time for.
struct HowLong {
    std::uint64_t rounds = ~std::uint64_t{0};
    Clock::time_point end = Clock::time_point::max();

    static std::optional<HowLong> of(const std::string& text) {
        char* unit = nullptr;
        const double number = std::strtod(text.c_str(), &unit);
        if (unit == text.c_str() || number < 0) return {};
        HowLong how_long;
        if (*unit == 's')
            how_long.end = Clock::now() + std::chrono::milliseconds(std::llround(number * 1e3));
        else
            how_long.rounds = static_cast<std::uint64_t>(number);
        return how_long;
    }
    bool goes_on(const Shared& shared) const {
        return shared.round < rounds && Clock::now() < end && shared.findings < kMaxFindings;
    }
};

// The rounds, in a child; after one that ended it, in the next child.
void run(const Walk& walk, const HowLong& how_long, Shared& shared) {
    while (how_long.goes_on(shared)) {
        const pid_t child = ::fork();
        if (child == 0) {
            for (; how_long.goes_on(shared); ++shared.round)
                do_round(walk, shared);
            ::_exit(0);
        }
        int status = 0;
        if (child < 0 || ::waitpid(child, &status, 0) != child) std::abort();
        if (WIFEXITED(status) && WEXITSTATUS(status) == 0) continue;
        tell(walk, shared.round,
             WIFSIGNALED(status) ? fmt::format("ended by signal {}", WTERMSIG(status))
                                 : fmt::format("exit code {}", WEXITSTATUS(status)));
        ++shared.findings;
        ++shared.round;
    }
}

int main(const std::vector<std::string>& words) {
    const auto how_long = words.size() < 4 ? std::nullopt : HowLong::of(words[0]);
    if (!how_long) {
        std::fputs("walk ROUNDS|SECONDSs SEED[:ROUND] SCRATCH FOLDER...\n", stderr);
        return 2;
    }
    char* rest = nullptr;
    std::uint64_t seed = std::strtoull(words[1].c_str(), &rest, 10);
    if (seed == 0)
        seed = static_cast<std::uint64_t>(
            std::chrono::system_clock::now().time_since_epoch().count() & 0xffffff);
    write_walk_models(words[2]);
    const Walk walk(seed, {words.begin() + 2, words.end()});
    void* const memory =
        ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED || walk.models() == 0) return 2;
    Shared& shared = *new (memory) Shared;
    if (*rest == ':') {
        shared.round = std::strtoull(rest + 1, nullptr, 10);
        do_round(walk, shared);
    } else {
        run(walk, *how_long, shared);
    }
    fmt::print("walk: seed {}: {} frames drawn, {} command lines refused, of {} models; {} "
               "broke a law\n",
               seed, shared.drawn, shared.refused, walk.models(), shared.findings);
    // A walk that draws next to nothing checks nothing.
    const bool enough = *rest == ':' || shared.drawn > shared.refused;
    return shared.findings == 0 && enough ? 0 : 1;
}

} // namespace
} // namespace scanout::test

int main(int argc, char** argv) {
    return scanout::test::main({argv + 1, argv + argc});
}
