// The program as a user meets it: words in, files, text and exit codes out.
#pragma once

#include "support/temporary_folder.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>

namespace scanout::app {

inline constexpr const char* kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

class Program : public ::testing::Test {
protected:
    struct Outcome {
        int code;
        std::string out, err;
        std::vector<std::string> lines() const {
            std::istringstream stream(out);
            std::vector<std::string> all;
            for (std::string line; std::getline(stream, line);)
                all.push_back(line);
            return all;
        }
        bool has(const std::string& text) const { return out.find(text) != std::string::npos; }
    };
    // In the folder; `words` as a shell reads them; $m is a model, $d the folder.
    Outcome run(const std::string& words) {
        const std::string command =
            "m='" + model + "'; d='" + folder.file("") + "'; cd \"$d\"; '" SCANOUT_BINARY "' " +
            words + " >" + folder.file("stdout") + " 2>" + folder.file("stderr") + " </dev/null";
        const int status = std::system(command.c_str());
        EXPECT_TRUE(WIFEXITED(status)) << words;
        return {WEXITSTATUS(status), folder.read("stdout"), folder.read("stderr")};
    }
    // The exit code, and that the error is one line.
    int refused(const std::string& words) {
        const Outcome outcome = run(words);
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1)
            << words << ": " << outcome.err;
        EXPECT_TRUE(outcome.err.starts_with("scanout: ")) << outcome.err;
        EXPECT_EQ(outcome.out, "") << words;
        return outcome.code;
    }
    std::string hash_of(const std::string& words) {
        const Outcome outcome = run("render $m --size 64x48 --hash " + words);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome.out;
    }

    scanout::test::TemporaryFolder folder;
    std::string model = folder.write("model.obj", kTetrahedron);
};

} // namespace scanout::app
