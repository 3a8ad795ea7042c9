#include "app/interrupt.h"

#include <csignal>

namespace scanout::app {
namespace {

volatile std::sig_atomic_t interrupted = 0;
struct sigaction before; // of SIGINT

void set_interrupted(int /*signal*/) {
    interrupted = 1;
}

} // namespace

Interrupt::Interrupt() {
    interrupted = 0;
    struct sigaction action {};
    action.sa_handler = set_interrupted;
    action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
    ::sigaction(SIGINT, &action, &before);
}

Interrupt::~Interrupt() {
    ::sigaction(SIGINT, &before, nullptr);
}

bool Interrupt::asked() {
    return interrupted != 0;
}

} // namespace scanout::app
