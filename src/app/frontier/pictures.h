// The points of a frontier as pictures: what is drawn, its error, its worst part. The HTML report
// embeds them, the contact sheet lays them out as one picture.
#pragma once

#include "app/frontier/report.h"
#include "image/image.h"

#include <string>
#include <vector>

namespace scanout::app {

struct ShownPoint {
    std::string what; // "The knee"
    std::size_t point = 0;
};
// The quickest, as asked for, the knee, the most accurate, each point once; without times what is
// asked for alone.
std::vector<ShownPoint> shown_points(const FrontierReport& report);
// "The knee (--aa samples_4): 0.812 codes RMSE, 3.10 ms"
std::string caption_of(const FrontierReport& report, const ShownPoint& shown);

inline constexpr int kCrop = 64; // pixels a side

struct PointPictures {
    image::Image drawn, heat; // heat: image/heat_map.h
    image::Image crop, right; // the worst kCrop x kCrop pixels, and what they should be
};
PointPictures pictures_of(const FrontierReport& report, std::size_t point); // draws it once more

// All of that under each other, crops enlarged, with captions.
image::Image contact_sheet(const FrontierReport& report);

} // namespace scanout::app
