// How far long work is: a share from 0 to 1, told now and then from the calling thread.
#pragma once

#include <functional>

namespace scanout::signal {

using Progress = std::function<void(double)>;

} // namespace scanout::signal
