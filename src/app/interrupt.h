// Ctrl-C that ends a measurement instead of the program: what there is counts.
#pragma once

namespace scanout::app {

// While it lives, the first SIGINT only sets a flag; the next one ends the program as usual. One at
// a time.
class Interrupt {
public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;
    static bool asked();
};

} // namespace scanout::app
