#include "io/gzip.h"

#include <algorithm>
#include <limits>

#include <zlib.h>

namespace scanout::io {
namespace {

class Inflater {
public:
    Inflater(std::string_view file, const std::string& path) : path_(path) {
        stream_.next_in =
            reinterpret_cast<Bytef*>(const_cast<char*>(file.data())); // not written to
        left_ = file.size();
        ready_ = ::inflateInit2(&stream_, kWindowBits + kGzipHeader) == Z_OK;
    }
    ~Inflater() { ::inflateEnd(&stream_); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    // As Mapping::Source: 0 at the end.
    Result<std::size_t> unpack(char* data, std::size_t room) {
        if (!ready_)
            return fail(Exit::unreadable, "{}: is too large for this machine's memory", path_);
        constexpr std::size_t kMaxRoom = std::numeric_limits<uInt>::max();
        while (!done_) {
            stream_.next_out = reinterpret_cast<Bytef*>(data);
            stream_.avail_out = static_cast<uInt>(std::min(room, kMaxRoom));
            const uInt out = stream_.avail_out;
            stream_.avail_in = static_cast<uInt>(std::min(left_, kMaxRoom));
            const uInt in = stream_.avail_in;
            const int status = ::inflate(&stream_, Z_NO_FLUSH);
            left_ -= in - stream_.avail_in;
            TRY_VOID(check(status));
            if (out != stream_.avail_out) return out - stream_.avail_out;
        }
        return std::size_t{0};
    }

private:
    static constexpr int kWindowBits = 15, kGzipHeader = 16; // of inflateInit2

    Result<> check(int status) {
        if (status == Z_STREAM_END) {
            // A member ends; another one may follow. Zeros behind are padding.
            done_ = left_ < 2 || stream_.next_in[0] != 0x1f || stream_.next_in[1] != 0x8b;
            ::inflateReset(&stream_);
            return {};
        }
        if (status == Z_OK) return {};
        if (status == Z_BUF_ERROR && left_ == 0)
            return fail(Exit::unreadable, "{}: the gzip file is cut short: fetch or copy it again",
                        path_);
        if (status == Z_MEM_ERROR)
            return fail(Exit::unreadable, "{}: is too large for this machine's memory", path_);
        return fail(Exit::unreadable, "{}: the gzip file is damaged ({}): fetch or copy it again",
                    path_, stream_.msg != nullptr ? stream_.msg : "no reason given");
    }

    const std::string& path_;
    z_stream stream_{};
    std::size_t left_ = 0; // bytes that are not unpacked yet
    bool ready_ = false, done_ = false;
};

} // namespace

Result<Mapping> gunzip(std::string_view file, const std::string& path, std::uint64_t max_bytes) {
    Inflater inflater(file, path);
    return Mapping::fill([&](char* data, std::size_t room) { return inflater.unpack(data, room); },
                         max_bytes, path);
}

} // namespace scanout::io
