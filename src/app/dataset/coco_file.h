// Annotations of images in the format of COCO (https://cocodataset.org/#format-data): instances with boxes
// and masks.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "app/dataset/labels.h"
#include "app/dataset/seen_things.h"

namespace roboss {

class CocoFile {
  public:
    /// Starts the file: annotations are written as they come. Errors: it cannot be written.
    static Result<CocoFile> create(const std::filesystem::path& file, LabelNames labels);

    struct ImageInfo {
        std::string file;  // below the folder of the data set
        int width = 0, height = 0, frame = 0;
        double time_s = 0;
        std::string camera;  // ROBOT/SENSOR
    };
    /// An image and what it shows; `visible` is the share of a thing's pixels that nothing hides. Masks are
    /// run lengths that are not compressed, as COCO has those of crowds; `iscrowd` is 0: each is one thing.
    void add(const ImageInfo& image, const std::vector<SeenThing>& things);
    /// Writes the images and categories behind the annotations.
    Result<> close();
    std::size_t annotations() const { return annotations_; }

  private:
    CocoFile() = default;

    std::filesystem::path path_;
    std::ofstream out_;
    LabelNames labels_;
    std::vector<ImageInfo> images_;
    std::size_t annotations_ = 0;
};

}  // namespace roboss
