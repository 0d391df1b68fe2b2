// See reading_files.h.
#include "app/dataset/reading_files.h"

#include <fmt/format.h>

#include <cstring>
#include <vector>

#include "app/output/array_file.h"

namespace roboss {
namespace {

/// dataset.json has them once.
bool is_constant(const ReadingField& field) {
    return std::strcmp(field.name, "intrinsics") == 0 || std::strcmp(field.name, "distortion") == 0;
}

/// A cell of a CSV file.
std::string csv_cell(const std::string& text) {
    std::string cell = "\"";
    for (const char c : text) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
    return cell + "\"";
}

/// Writes the arrays of a reading, and collects its other numbers with their names.
struct FrameWriter {
    const std::filesystem::path& folder;
    const std::string& frame;
    Result<>& done;
    std::string& names;
    std::string& cells;
    std::size_t& files;

    std::string file_of(const ReadingField& field, const char* ending) const {
        std::error_code error;
        std::filesystem::create_directories(folder / field.name, error);
        ++files;
        return (folder / field.name / (frame + ending)).string();
    }
    template <class T>
    void number(const std::string& name, T value) const {
        names += "," + name;
        cells += fmt::format(",{}", value);
    }
    void keep(const Result<>& written) const {
        if (done && !written) done = written;
    }
    void operator()(const ReadingField& field, const Image<float>& image) const {
        if (!image.empty()) keep(write_image(file_of(field, ".png"), image, field.unit));
    }
    template <class T>
    void operator()(const ReadingField& field, const Image<T>& image) const {
        if (!image.empty()) keep(write_image(file_of(field, ".png"), image));
    }
    void operator()(const ReadingField& field, const std::vector<double>& values) const {
        if (!is_constant(field) && !(values.empty() && std::strcmp(field.name, "intensities") == 0))
            keep(write_bytes(file_of(field, ".npy"), npy({static_cast<int>(values.size())}, values)));
    }
    void operator()(const ReadingField& field, const std::vector<std::string>& texts) const {
        std::string all;
        for (const std::string& text : texts) all += (all.empty() ? "" : ";") + text;
        names += std::string(",") + field.name;
        cells += "," + csv_cell(all);
    }
    void operator()(const ReadingField& field, const Vec3& v) const {
        const char* const axes[] = {"_x", "_y", "_z"};
        for (std::size_t i = 0; i < 3; ++i) number(std::string(field.name) + axes[i], v[i]);
    }
    void operator()(const ReadingField& field, const Quat& q) const {
        const std::string name = field.name;
        number(name + "_w", q.w), number(name + "_x", q.x), number(name + "_y", q.y),
            number(name + "_z", q.z);
    }
    template <class Value>
    requires std::is_arithmetic_v<Value>
    void operator()(const ReadingField& field, Value value) const {
        number(field.name, static_cast<double>(value));
    }
};

}  // namespace

std::string frame_name(int frame) {
    return fmt::format("{:06}", frame);
}

Result<> ReadingFiles::write(int frame, double time_s, const Sample& sample) {
    Result<> done = Ok{};
    std::string names = "frame,time_s", cells = fmt::format("{},{}", frame, time_s);
    const std::string name = frame_name(frame);
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    visit_fields(sample, FrameWriter{folder_, name, done, names, cells, files_});
    if (names == "frame,time_s") return done;
    if (!table_.is_open()) {
        table_.open(folder_ / "readings.csv");
        table_ << names << "\n";
    }
    table_ << cells << "\n";
    return done;
}

Result<> ReadingFiles::close() {
    if (!table_.is_open()) return Ok{};
    table_.flush();
    if (table_) return Ok{};
    return Error{(folder_ / "readings.csv").string() + " cannot be written",
                 "check the folder, its permissions and the free space", "not-writable"};
}

}  // namespace roboss
