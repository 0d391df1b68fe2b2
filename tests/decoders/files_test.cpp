// Files of others, changed at random: worlds (SDFormat, URDF, MJCF), meshes and pictures are read, or refused
// with a reason. Messages of ROS 2 and Foxglove: messages_test.cpp, orders_test.cpp. The decoders of messages
// of the cluster, Models, scenes and journals are tested the same way in their layers.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>

#include <support/folder.h>

#include "changes.h"
#include "mesh/image_file.h"
#include "mesh/jpeg_image.h"
#include "mesh/mesh_file.h"
#include "mesh/msh_file.h"
#include "mesh/picture_file.h"
#include "model/model.h"
#include "sdf/load_world.h"

namespace roboss::test {
namespace {

namespace fs = std::filesystem;

const std::string kSource = ROBOSS_SOURCE, kCases = kSource + "/tests/decoders/cases";

/// Small files of the tree, in the order of their names.
std::vector<fs::path> small_files(const std::vector<std::string>& folders,
                                  const std::vector<std::string>& endings) {
    std::vector<fs::path> files;
    for (const std::string& folder : folders)
        for (const auto& file : fs::directory_iterator(kSource + "/" + folder))
            if (std::ranges::count(endings, file.path().extension().string()) > 0 && file.file_size() < 5'000)
                files.push_back(file.path());
    std::ranges::sort(files);
    return files;
}

/// The worlds that load today.
void expect_total_worlds(const std::string& name, const std::vector<std::string>& folders,
                         const std::vector<std::string>& endings) {
    std::vector<fs::path> paths;
    Decoder decoder{name, {}, 1'000, {}};
    const auto loads = [&](const std::string& text, const fs::path& path) {
        Diagnostics diagnostics;
        const std::optional<World> world = load_world_text(text, path.string(), {}, diagnostics);
        if (!world) {
            EXPECT_TRUE(diagnostics.has_errors()) << "refused without a reason";
            return false;
        }
        Diagnostics more;
        return !diagnostics.has_errors() && compile(*world, {}, more) != nullptr;
    };
    for (const fs::path& path : small_files(folders, endings))
        if (std::string text = contents(path); loads(text, path)) {
            decoder.good.push_back(std::move(text));
            paths.push_back(path);
        }
    decoder.read = [&](const std::string& text, std::size_t which) { return loads(text, paths[which]); };
    expect_total(decoder, kCases);
}

TEST(Decoders, TakeOrRefuseAnySdf) {
    expect_total_worlds("sdf",
                        {"tests/cases", "worlds/models/rover", "worlds/models/four_bar",
                         "worlds/models/press", "src/app/templates", "web/e2e"},
                        {".sdf", ".world"});
}

TEST(Decoders, TakeOrRefuseAnyUrdf) {
    expect_total_worlds("urdf", {"tests/cases", "src/app/templates", "examples/first_robot"}, {".urdf"});
}

TEST(Decoders, TakeOrRefuseAnyMjcf) {
    expect_total_worlds("mjcf", {"tests/cases", "tests/mjcf"}, {".xml"});
}

TEST(Decoders, KeepTheInputThatEndsTheProcess) {
    Decoder decoder{"ends", {"good"}, 1'000, {}};
    decoder.read = [](const std::string& bytes, std::size_t) {
        if (bytes.find('\xFF') != std::string::npos) std::abort();
        return true;
    };
    for (const auto& file : fs::directory_iterator("."))
        ASSERT_NE(file.path().filename().string().rfind("failed-ends-", 0), 0u) << "left by a run before";
    EXPECT_EXIT(expect_total(decoder, kCases), ::testing::KilledBySignal(SIGABRT),
                "the input is kept: failed-ends-");
    std::vector<fs::path> kept;
    for (const auto& file : fs::directory_iterator("."))
        if (file.path().filename().string().rfind("failed-ends-", 0) == 0) kept.push_back(file.path());
    ASSERT_EQ(kept.size(), 1u);
    EXPECT_NE(contents(kept[0]).find('\xFF'), std::string::npos);
    fs::remove(kept[0]);
}

/// Reads it from a file of this ending.
void expect_total_meshes(const std::string& ending, std::vector<std::string> good) {
    const Folder folder;
    Decoder decoder{
        ending, std::move(good), ending == "msh" ? 500u : 60u, {}};  // assimp reads in a process of its own
    decoder.read = [&](const std::string& bytes, std::size_t) {
        const std::string path = folder.write("mesh." + ending, bytes);
        if (ending == "msh") return taken(read_msh(path));
        const bool drawn = taken(read_mesh_parts({path, {1, 1, 1}, "", false}));
        return taken(read_mesh({path, {1, 1, 1}, "", false})) && drawn;
    };
    expect_total(decoder, kCases);
}

TEST(Decoders, TakeOrRefuseAnyMesh) {
    const std::string shapes = kSource + "/worlds/models/shapes/";
    expect_total_meshes("stl",
                        {contents(shapes + "crate.stl"), contents(kSource + "/tests/mjcf/meshes/bowl.stl")});
    expect_total_meshes("obj",
                        {contents(shapes + "gem.obj"), contents(kSource + "/tests/mjcf/meshes/wedge.obj")});
    expect_total_meshes("dae", {contents(shapes + "stair.dae")});
    expect_total_meshes(
        "ply", {"ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
                "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 2 3\n"});
}

TEST(Decoders, TakeOrRefuseAnyMshFile) {
    const std::int32_t head[] = {4, 0, 0, 2}, faces[] = {0, 1, 2, 0, 2, 3};
    const float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    std::string bytes;
    const auto add = [&](const auto& values) {
        bytes.append(reinterpret_cast<const char*>(values), sizeof values);
    };
    add(head), add(corners), add(faces);
    expect_total_meshes("msh", {bytes});
}

std::vector<std::uint8_t> as_bytes(const std::string& text) {
    return {text.begin(), text.end()};
}

TEST(Decoders, TakeOrRefuseAnyPicture) {
    const Folder folder;
    std::vector<std::uint8_t> samples(16 * 12 * 3);
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = static_cast<std::uint8_t>(i * 7);
    const std::vector<std::uint8_t> jpeg = encode_jpeg(16, 12, 3, samples, 80).value();
    Decoder decoder{"pictures",
                    {contents(kSource + "/worlds/models/yard/sign.png"),
                     contents(kSource + "/worlds/models/yard/rivets.png"),
                     {jpeg.begin(), jpeg.end()}},
                    2'000,
                    {}};
    decoder.read = [&](const std::string& bytes, std::size_t) {
        (void)taken(read_png(folder.write("picture", bytes)));
        const Result<PictureSpec> picture = picture_in(as_bytes(bytes), "a picture");
        return taken(picture) && taken(decode_picture(picture.value()));
    };
    expect_total(decoder, kCases);
}

}  // namespace
}  // namespace roboss::test
