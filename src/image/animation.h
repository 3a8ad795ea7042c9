// Pictures that move: an animated PNG as one file, and the frames of a Y4M stream.
#pragma once

#include "base/result.h"
#include "image/codec.h"
#include "image/image.h"

#include <cstdint>
#include <string>

namespace scanout::image {

// An animated PNG (PNG, third edition, 11.3.5), RGBA, which repeats for ever. A program that does
// not know of animations shows the first picture. Same bytes for the same pictures.
class AnimatedPng {
public:
    explicit AnimatedPng(int frames_per_second) : frames_per_second_(frames_per_second) {}

    // All pictures have the size of the first. Exit::internal for one without pixels.
    Result<void> add(const Image& picture);
    Bytes file() const; // of one picture or more

private:
    void add_frame_control(const Image& picture);

    int frames_per_second_;
    std::uint32_t frames_ = 0, sequence_ = 0;
    Bytes header_; // the signature and the chunk IHDR
    Bytes chunks_; // of the frames
};

// YUV4MPEG2, which video encoders read: 4:4:4, limited range by Rec. ITU-R BT.601, which readers
// assume where a stream does not say it. Alpha is dropped; rounding loses
// colours.
std::string y4m_header(int width, int height, int frames_per_second);
Bytes y4m_frame(const Image& picture);

} // namespace scanout::image
