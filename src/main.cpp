#include "app/commands.h"
#include "base/float_environment.h"

int main(int argc, char** argv) {
    const scanout::FloatEnvironment plain;
    return static_cast<int>(scanout::app::run(argc, argv));
}
