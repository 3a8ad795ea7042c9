// A contact sheet: pictures of one size in columns and rows, each with a line of text below.
#pragma once

#include "app/options/settings.h"
#include "app/options/values.h"
#include "image/image.h"

#include <string>

namespace scanout::app {

class Sheet {
public:
    Sheet(int columns, int rows, int width, int height); // of each picture, pixels

    // Into the next cell, from left to right, then down. Opaque: a sheet is of paper.
    void add(const image::Image& picture, const std::string& caption);
    const image::Image& picture() const { return picture_; }

    // Pixels of the whole.
    static Size size_of(const SheetGrid& grid, int width, int height);

private:
    SheetGrid grid_;
    int width_, height_, next_ = 0;
    image::Image picture_;
};

} // namespace scanout::app
