// Tells that one of some files was written anew, or came to be (inotify(7)).
#pragma once

#include "base/fd.h"
#include "base/result.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace scanout::app {

class FileWatch {
public:
    static Result<FileWatch> create();

    // These files alone from now on. Their folders are watched, as programs replace files rather
    // than write into them; a folder that is not there is not.
    void watch(const std::vector<std::string>& paths);

    int event_fd() const { return fd_.get(); }
    // Takes what has happened since the last call: was one of the files closed after writing, or
    // put in its place?
    bool take_changes();

private:
    explicit FileWatch(Fd fd) : fd_(std::move(fd)) {}

    Fd fd_;
    std::map<int, std::set<std::string>> names_; // by the watch of their folder
};

} // namespace scanout::app
