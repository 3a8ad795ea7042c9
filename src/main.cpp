#include "app/command/commands.h"

int main(int argc, char** argv) {
    return static_cast<int>(scanout::app::run(argc, argv));
}
