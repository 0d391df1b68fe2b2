// Painted from the back: ground, shadows, shapes from low to high, paths, their starts and ends, and a margin
// with title, scale bar and key. Colours are a dozen hues of like lightness, so no robot shouts; the same
// robot keeps its colour.
#include "app/output/path_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include "app/text.h"
#include "core/fixed_math.h"
#include "core/markup.h"

namespace roboss {
namespace {

constexpr double kMargin = 32, kHeader = 84, kFooter = 58;  // px
constexpr const char* kPathColours[] = {"#d1495b", "#2e7d9a", "#e08e2b", "#3f9263", "#7d5ba6", "#c2577f",
                                        "#4f6fc4", "#a07a1f", "#1f9a93", "#b5562f", "#6b8e23", "#8a4f6d"};

struct Point {
    double x = 0, y = 0;
};

const char* colour_of(std::size_t path) {
    return kPathColours[path % std::size(kPathColours)];
}

/// Without points that are nowhere.
std::vector<RobotPath> finite_paths(const std::vector<RobotPath>& paths) {
    std::vector<RobotPath> finite = paths;
    for (RobotPath& path : finite) std::erase_if(path.points_W, [](const Vec3& p) { return !is_finite(p); });
    return finite;
}

double cross2(const Point& o, const Point& a, const Point& b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/// Andrew's monotone chain (1979), counter-clockwise.
std::vector<Point> convex_hull(std::vector<Point> points) {
    std::sort(points.begin(), points.end(),
              [](const Point& a, const Point& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    std::vector<Point> hull;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t start = hull.size();
        for (const Point& p : points) {
            while (hull.size() >= start + 2 && cross2(hull[hull.size() - 2], hull.back(), p) <= 0)
                hull.pop_back();
            hull.push_back(p);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

/// Points of the shape's surface whose hull is its outline from above.
std::vector<Vec3> outline_points(const Shape& shape) {
    std::vector<Vec3> points;
    if (shape.kind == ShapeKind::kBox) {
        for (double x : {-shape.half.x, shape.half.x})
            for (double y : {-shape.half.y, shape.half.y})
                for (double z : {-shape.half.z, shape.half.z}) points.push_back({x, y, z});
        return points;
    }
    if (shape.kind == ShapeKind::kHull) return shape.hull->vertices;
    if (shape.kind == ShapeKind::kSurface) {
        const Aabb& box = shape.surface->box();
        for (double x : {box.min.x, box.max.x})
            for (double y : {box.min.y, box.max.y})
                for (double z : {box.min.z, box.max.z}) points.push_back({x, y, z});
        return points;
    }
    constexpr int kCorners = 32;
    if (shape.kind == ShapeKind::kEllipsoid) {
        for (int j = 1; j < kCorners / 2; ++j)
            for (int i = 0; i < kCorners; ++i) {
                const SinCos a = fixed_sincos(2 * kPi * i / kCorners),
                             b = fixed_sincos(2 * kPi * j / kCorners);
                points.push_back(
                    {shape.half.x * a.cos * b.sin, shape.half.y * a.sin * b.sin, shape.half.z * b.cos});
            }
        return points;
    }
    for (double z : {-shape.half_length, shape.half_length})
        for (int i = 0; i < kCorners; ++i) {
            const SinCos a = fixed_sincos(2 * kPi * i / kCorners);
            points.push_back({shape.radius * a.cos, shape.radius * a.sin, z});
        }
    return points;
}

std::vector<Point> footprint(const Shape& shape, const Transform& X_WS) {
    std::vector<Point> points;
    const bool round = shape.kind == ShapeKind::kSphere || shape.kind == ShapeKind::kCapsule;
    for (const Vec3& p_S : outline_points(shape)) {
        // a sphere's outline is the same however it is turned; a capsule's is that of its two spheres
        const Vec3 p = round ? X_WS * Vec3{0, 0, p_S.z} + Vec3{p_S.x, p_S.y, 0} : X_WS * p_S;
        points.push_back({p.x, p.y});
    }
    return convex_hull(std::move(points));
}

struct Drawn {
    std::vector<Point> outline;
    double top = 0;
    const std::string* name = nullptr;
};

double length_of(const RobotPath& path) {
    double length = 0;
    for (std::size_t i = 1; i < path.points_W.size(); ++i) {
        const Vec3 step = path.points_W[i] - path.points_W[i - 1];
        length += std::sqrt(step.x * step.x + step.y * step.y);
    }
    return length;
}

/// The painter: keeps the view and the text.
class Picture {
  public:
    Picture(const Model& model, const std::vector<RobotPath>& paths, const PictureOptions& options)
        : paths_(finite_paths(paths)), options_(options) {
        for (const StaticShape& fixed : model.statics)
            if (fixed.shape.kind != ShapeKind::kPlane)
                shapes_.push_back(
                    {footprint(fixed.shape, fixed.X_WS), bounds(fixed.shape, fixed.X_WS).max.z, &fixed.name});
        std::stable_sort(shapes_.begin(), shapes_.end(),
                         [](const Drawn& a, const Drawn& b) { return a.top < b.top; });
        frame_everything();
    }

    std::string paint() {
        begin();
        paint_shapes();
        paint_paths();
        paint_header();
        paint_footer();
        add(text_, "</svg>\n");
        return fmt::to_string(text_);
    }

  private:
    void frame_everything();
    void begin();
    void paint_shapes();
    void paint_paths();
    void paint_header();
    void paint_footer();
    void paint_scale_bar(double y);
    std::string polygon(const std::vector<Point>& outline, double shift_px) const;
    std::string polyline(const RobotPath& path) const;
    double px(double x) const { return kMargin + (x - left_) * scale_; }
    double py(double y) const { return kHeader + (top_ - y) * scale_; }

    const std::vector<RobotPath> paths_;
    const PictureOptions& options_;
    std::vector<Drawn> shapes_;
    double left_ = 0, top_ = 0, scale_ = 1, map_width_ = 0, map_height_ = 0;
    Text text_;
};

void Picture::frame_everything() {
    Aabb all;
    for (const Drawn& shape : shapes_)
        for (const Point& p : shape.outline) all.include(Vec3{p.x, p.y, 0});
    for (const RobotPath& path : paths_)
        for (const Vec3& p : path.points_W) all.include(Vec3{p.x, p.y, 0});
    if (all.empty()) all.include(Vec3{0, 0, 0});
    const double pad = 0.01 * std::fmax(all.max.x - all.min.x, all.max.y - all.min.y) + 0.5;
    all = all.inflated(pad);
    left_ = all.min.x, top_ = all.max.y;
    map_width_ = options_.width_px - 2 * kMargin;
    scale_ = map_width_ / (all.max.x - all.min.x);
    map_height_ = (all.max.y - all.min.y) * scale_;
}

void Picture::begin() {
    const double height = kHeader + map_height_ + kFooter;
    add(text_,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
        "height=\"{1:.0f}\" "
        "font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\">\n",
        options_.width_px, height);
    add(text_, "<rect width=\"100%\" height=\"100%\" fill=\"#fbfaf7\"/>\n");
    add(text_,
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" rx=\"6\" fill=\"#f1efea\"/>\n",
        kMargin, kHeader, map_width_, map_height_);
}

std::string Picture::polygon(const std::vector<Point>& outline, double shift_px) const {
    Text points;
    for (const Point& p : outline) add(points, "{:.1f},{:.1f} ", px(p.x) + shift_px, py(p.y) + shift_px);
    return fmt::to_string(points);
}

/// Shadows first, all of them, so that no shadow falls on a neighbour's roof.
void Picture::paint_shapes() {
    add(text_, "<g fill=\"#000000\" fill-opacity=\"0.07\">\n");
    for (const Drawn& shape : shapes_) {
        const double shift = std::fmin(0.12 * shape.top, 0.8) * scale_;
        add(text_, "<polygon points=\"{}\"/>\n", polygon(shape.outline, std::fmin(shift, 6.0)));
    }
    add(text_, "</g>\n<g stroke=\"#ffffff\" stroke-width=\"0.8\" stroke-linejoin=\"round\">\n");
    for (const Drawn& shape : shapes_) {
        const bool low = shape.top < 1.0;
        const int shade = 198 - static_cast<int>(std::fmin(std::fmax(shape.top - 1.0, 0.0), 6.0) * 6.0);
        const std::string fill = low ? "#93a0ad" : fmt::format("rgb({},{},{})", shade, shade - 4, shade - 12);
        add(text_, "<polygon points=\"{}\" fill=\"{}\"><title>{}</title></polygon>\n",
            polygon(shape.outline, 0), fill, escaped(*shape.name));
    }
    add(text_, "</g>\n");
}

/// Points nearer than a third of a pixel to the last one drawn are left out.
std::string Picture::polyline(const RobotPath& path) const {
    Text points;
    Point last{-1e9, -1e9};
    for (std::size_t i = 0; i < path.points_W.size(); ++i) {
        const Vec3& p = path.points_W[i];
        const Point here{px(p.x), py(p.y)};
        const bool end = i + 1 == path.points_W.size();
        if (!end && std::fabs(here.x - last.x) + std::fabs(here.y - last.y) < 0.33) continue;
        add(points, "{:.1f},{:.1f} ", here.x, here.y);
        last = here;
    }
    return fmt::to_string(points);
}

/// Each path has a pale edge, so that where two cross one sees which is which.
void Picture::paint_paths() {
    const double width = std::clamp(0.12 * scale_, 0.7, 2.4);
    add(text_, "<defs>\n");
    for (std::size_t i = 0; i < paths_.size(); ++i)
        add(text_, "<polyline id=\"path{}\" points=\"{}\"/>\n", i, polyline(paths_[i]));
    add(text_, "</defs>\n<g fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\n");
    for (std::size_t i = 0; i < paths_.size(); ++i) {
        add(text_,
            "<use href=\"#path{}\" stroke=\"#fbfaf7\" stroke-opacity=\"0.55\" stroke-width=\"{:.2f}\"/>", i,
            2.2 * width);
        add(text_,
            "<use href=\"#path{}\" stroke=\"{}\" stroke-opacity=\"0.9\" stroke-width=\"{:.2f}\"><title>{}: "
            "{:.1f} m</title></use>\n",
            i, colour_of(i), width, escaped(paths_[i].robot), length_of(paths_[i]));
    }
    add(text_, "</g>\n<g stroke-width=\"{:.2f}\">\n", 0.7 * width);
    for (std::size_t i = 0; i < paths_.size(); ++i) {
        if (paths_[i].points_W.empty()) continue;
        const Vec3 &first = paths_[i].points_W.front(), &last = paths_[i].points_W.back();
        add(text_, "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"#fbfaf7\" stroke=\"{}\"/>",
            px(first.x), py(first.y), 1.4 * width, colour_of(i));
        add(text_, "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"{}\" stroke=\"#ffffff\"/>\n",
            px(last.x), py(last.y), 2.1 * width, colour_of(i));
    }
    add(text_, "</g>\n");
}

void Picture::paint_header() {
    add(text_,
        "<text x=\"{:.0f}\" y=\"42\" font-size=\"24\" font-weight=\"600\" fill=\"#22262b\">{}</text>\n",
        kMargin, escaped(options_.title));
    add(text_, "<text x=\"{:.0f}\" y=\"66\" font-size=\"14\" fill=\"#666c74\">{}</text>\n", kMargin,
        escaped(options_.subtitle));
}

/// A bar of 1, 2 or 5 times a power of ten metres, about a seventh of the width.
void Picture::paint_scale_bar(double y) {
    double metres = 0.1, decade = 0.1;
    for (int i = 0; i < 8; ++i, decade *= 10)
        for (double step : {1.0, 2.0, 5.0})
            if (step * decade * scale_ <= map_width_ / 7) metres = step * decade;
    const double right = kMargin + map_width_, left = right - metres * scale_;
    add(text_,
        "<path d=\"M{0:.1f},{2:.1f} v6 H{1:.1f} v-6\" fill=\"none\" stroke=\"#22262b\" "
        "stroke-width=\"1.5\"/>\n",
        left, right, y - 6);
    add(text_,
        "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"13\" fill=\"#22262b\" text-anchor=\"middle\">{:g} "
        "m</text>\n",
        0.5 * (left + right), y + 17, metres);
}

void Picture::paint_footer() {
    const double y = kHeader + map_height_ + 24;
    add(text_,
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"#fbfaf7\" stroke=\"#666c74\" "
        "stroke-width=\"1.6\"/>",
        kMargin + 5, y - 4);
    add(text_, "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"13\" fill=\"#666c74\">start</text>\n",
        kMargin + 16, y);
    add(text_, "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5.5\" fill=\"#666c74\"/>", kMargin + 72, y - 4);
    add(text_, "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"13\" fill=\"#666c74\">end</text>\n", kMargin + 84,
        y);
    std::vector<double> lengths;
    for (const RobotPath& path : paths_) lengths.push_back(length_of(path));
    std::sort(lengths.begin(), lengths.end());
    if (!lengths.empty())
        add(text_,
            "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"13\" fill=\"#666c74\">distance driven: shortest "
            "{:.0f} "
            "m, median {:.0f} m, longest {:.0f} m</text>\n",
            kMargin + 136, y, lengths.front(), lengths[lengths.size() / 2], lengths.back());
    paint_scale_bar(y);
}

}  // namespace

std::string path_picture(const Model& model, const std::vector<RobotPath>& paths,
                         const PictureOptions& options) {
    return Picture(model, paths, options).paint();
}

Result<> write_path_picture(const std::string& file, const Model& model, const std::vector<RobotPath>& paths,
                            const PictureOptions& options) {
    std::ofstream out(file, std::ios::binary);
    out << path_picture(model, paths, options) << std::flush;
    if (!out)
        return Error{"cannot write the picture " + file,
                     "name a file in a folder that exists and is writable", "not-writable"};
    return Ok{};
}

}  // namespace roboss
