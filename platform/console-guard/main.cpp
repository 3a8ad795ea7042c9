// console-guard KEYBOARD_MODE PROGRAM SERVER: watches the processes PROGRAM and SERVER (-1: none),
// and gives the console on descriptor 1 back when PROGRAM ends without a byte on descriptor 0.
// scanout starts it: a program of its own name, which no signal to scanout's name or group reaches.
#include "platform/guard_watch.h"

#include <cstdlib>

int main(int count, char** words) {
    if (count != 4) return 64; // Exit::usage: nobody calls this by hand
    const auto number = [&](int word) {
        return static_cast<int>(std::strtol(words[word], nullptr, 10));
    };
    scanout::console::watch(0, {1, number(1)}, {number(2), number(3)});
}
