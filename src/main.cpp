#include "app/commands.h"
#include "base/memory.h"

int main(int argc, char** argv) {
    const std::uint64_t start_bytes = scanout::resident_bytes();
    return static_cast<int>(scanout::app::run(argc, argv, start_bytes));
}
