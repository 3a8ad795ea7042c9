// Functions that all kinds of seat share: opening device nodes, and taking and giving up DRM
// master.
#pragma once

#include "base/result.h"

#include <map>
#include <string>

namespace scanout::console {

// open(2) for reading and writing, not blocking; the error is the errno.
tl::expected<int, int> open_device_node(const std::string& path);

// The cards among the open devices: a switch of the console takes their master and gives it back.
class Cards {
public:
    void opened(const std::string& path, int fd);
    void closed(int fd) { paths_.erase(fd); }
    void set_master() const;
    void drop_master() const;

private:
    std::map<int, std::string> paths_;
};

// Is some other process drawing on this card right now (it is DRM master)?
bool has_another_master(const std::string& card);
// The first card of this machine on which one does; else "".
std::string card_with_another_master();

// Who has the device open besides us and our children (the seat's server), as far as /proc lets us
// see, to be put behind what is said of it: " (kmscon, process 512)"; else "".
std::string held_by(const std::string& path);

} // namespace scanout::console
