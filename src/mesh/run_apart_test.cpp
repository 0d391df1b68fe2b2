// What a reader does to its process stays there.
#include "mesh/run_apart.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <vector>

#include <support/folder.h>

#include "mesh/mesh_bytes.h"
#include "mesh/mesh_file.h"

namespace roboss {
namespace {

constexpr std::size_t kGiB = std::size_t{1} << 30;

TEST(RunApart, GivesWhatTheWorkGives) {
    for (const std::size_t size : {0, 1, 100'000, 3'000'000}) {
        const auto result = run_apart([&] { return std::string(size, 'x'); });
        ASSERT_TRUE(result.ok()) << result.error().text();
        EXPECT_EQ(result.value(), std::string(size, 'x'));
    }
}

TEST(RunApart, AProcessThatEndsIsAnError) {
    const std::vector<std::function<std::string()>> endings{
        [] { return _exit(0), ""; },
        [] { return raise(SIGSEGV), ""; },
        [] { return raise(SIGABRT), ""; },
        []() -> std::string { throw std::runtime_error("of no avail"); },
    };
    for (const auto& work : endings) {
        const auto result = run_apart(work);
        ASSERT_FALSE(result.ok());
        EXPECT_EQ(result.error().code, "reader-ended");
        EXPECT_FALSE(result.error().remedy.empty());
    }
}

TEST(RunApart, AProcessThatIsEndedFromOutsideIsNoDamagedFile) {
    for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
        const auto result = run_apart([&] { return raise(signal), ""; });
        ASSERT_FALSE(result.ok());
        EXPECT_EQ(result.error().code, "reader-stopped");
        EXPECT_EQ(result.error().text().find("damaged"), std::string::npos);
    }
}

TEST(RunApart, ALoopWithoutEndIsAnError) {
    const auto idle = run_apart([] { return pause(), ""; }, {1, kGiB, 60});
    ASSERT_FALSE(idle.ok());
    EXPECT_EQ(idle.error().code, "reader-limit");
    EXPECT_NE(idle.error().message.find("more than 1 s"), std::string::npos);
    const auto busy = run_apart(
        [] {
            for (volatile int i = 0;;) i = 1 - i;
            return "";
        },
        {60, kGiB, 1});
    ASSERT_FALSE(busy.ok());
    EXPECT_EQ(busy.error().code, "reader-limit");
    EXPECT_NE(busy.error().message.find("1 s of computing time"), std::string::npos);
}

TEST(RunApart, TooMuchMemoryIsAnError) {
    const auto work = [] {
        try {
            return std::string(3 * kGiB, 'x');
        } catch (const std::exception& error) {  // as assimp does
            return std::string(error.what());
        }
    };
    const auto result = run_apart(work, {60, kGiB});
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, "reader-limit");
    EXPECT_NE(result.error().message.find("memory"), std::string::npos);
}

TEST(RunApart, TheResultCountsThoughAnotherProcessHoldsThePipe) {
    const auto start = std::chrono::steady_clock::now();
    const auto result = run_apart([] {
        if (fork() == 0) sleep(10), _exit(0);
        return "x";
    });
    EXPECT_TRUE(result.ok());
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST(RunApart, ThreadsReadAtOnce) {
    std::vector<std::thread> threads;
    std::atomic<int> good = 0;
    for (int i = 0; i < 4; ++i)
        threads.emplace_back([&] {
            for (int k = 0; k < 20; ++k) good += run_apart([] { return "x"; }).ok();
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(good, 80);
}

TEST(RunApart, TimeInWhichTheProgramIsStoppedDoesNotCount) {
    const pid_t id = fork();
    if (id == 0) _exit(run_apart([] { return usleep(600'000), "x"; }, {1, kGiB}).ok() ? 0 : 1);
    usleep(200'000);
    (void)kill(id, SIGSTOP);
    sleep(2);
    (void)kill(id, SIGCONT);
    int status = -1;
    (void)waitpid(id, &status, 0);
    EXPECT_EQ(status, 0);
}

TEST(RunApart, StandardStreamsMayBeClosed) {
    for (const int other : {STDIN_FILENO, STDOUT_FILENO}) {
        const pid_t id = fork();
        if (id == 0) {
            (void)close(other), (void)close(STDERR_FILENO);
            const auto result = run_apart([] { return "x"; });
            _exit(result.ok() && result.value() == "x" ? 0 : 1);
        }
        int status = -1;
        (void)waitpid(id, &status, 0);
        EXPECT_EQ(status, 0);
    }
}

TEST(RunApart, WhereNoProcessCanBeMadeTheErrorSaysWhy) {
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &before), 0);
    const rlimit none{0, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &none), 0);
    const auto result = run_apart([] { return "x"; });
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &before), 0);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, "reader-not-started");
    EXPECT_NE(result.error().message.find(std::strerror(EMFILE)), std::string::npos);
    EXPECT_NE(result.error().remedy.find("ulimit"), std::string::npos);
}

TEST(MeshBytes, ComeBackAsTheyWere) {
    MeshPart part{{"a.fbx", {{1, 2, 3}, {4, 5, 6}, {7, 8, 10}}, {{0, 1, 2}}, {{0, 1}, {1, 0}, {1, 1}}},
                  Vec3{0.5, 0, 1},
                  0.25,
                  {"p.png", {1, 2, 3}},
                  {}};
    const auto parts = parts_from_bytes(parts_to_bytes(std::vector<MeshPart>{part, {}}));
    ASSERT_TRUE(parts.ok()) << parts.error().text();
    ASSERT_EQ(parts.value().size(), 2u);
    const MeshPart& back = parts.value()[0];
    EXPECT_EQ(back.mesh.source, "a.fbx");
    EXPECT_EQ(back.mesh.vertices[2].z, 10);
    EXPECT_EQ(back.mesh.triangles, part.mesh.triangles);
    EXPECT_EQ(back.mesh.uv, part.mesh.uv);
    EXPECT_EQ(back.rgb->z, 1);
    EXPECT_EQ(back.alpha, 0.25);
    EXPECT_EQ(back.colour.bytes, part.colour.bytes);
    EXPECT_FALSE(parts.value()[1].rgb);
    const auto failed = mesh_from_bytes(mesh_to_bytes(Error{"what", "remedy", "code"}));
    ASSERT_FALSE(failed.ok());
    EXPECT_EQ(failed.error().text(), "what [code]\n  remedy: remedy");
}

TEST(MeshBytes, DamagedOnesAreAnError) {
    const MeshFile file{{"a.ply", {{1, 2, 3}, {4, 5, 6}, {7, 8, 10}}, {{0, 1, 2}}, {}}, 7};
    const std::string whole = mesh_to_bytes(file);
    EXPECT_EQ(mesh_from_bytes(whole).value().dropped, 7u);
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_FALSE(mesh_from_bytes(whole.substr(0, size)).ok()) << size;
    MeshFile wrong = file;
    wrong.mesh.triangles[0][1] = 3;
    EXPECT_FALSE(mesh_from_bytes(mesh_to_bytes(wrong)).ok());
}

// assimp 5.2 writes to the material that does not exist; 5.4 reads the file.
TEST(MeshFile, AnObjFileWhosePicturesHaveNoMaterialIsReadOrAnError) {
    const test::Folder folder;
    folder.write("a.mtl", "map_Kd a.png\n");
    const std::string path =
        folder.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
    const auto file = read_mesh({path, {1, 1, 1}, "", false});
    if (file.ok())
        EXPECT_EQ(file.value().mesh.triangles.size(), 1u);
    else
        EXPECT_EQ(file.error().code, "reader-ended");
    folder.write("a.mtl", "newmtl m\nmap_Kd a.png\n");
    EXPECT_TRUE(read_mesh({path, {1, 1, 1}, "", false}).ok());
}

// assimp 5.2 frees a picture twice whose text is no picture; 5.4 reads the file.
TEST(MeshFile, AnFbxFileThatEndsItsReaderIsReadOrAnError) {
    const test::Folder folder;
    const std::string text =
        "; FBX 7.3.0 project file\nFBXHeaderExtension: {\n FBXHeaderVersion: 1003\n FBXVersion: 7300\n}\n"
        "Objects: {\n Geometry: 100, \"Geometry::part\", \"Mesh\" {\n  Vertices: *9 {\n   a: "
        "0,0,0,1,0,0,0,1,0\n  }\n  PolygonVertexIndex: *3 {\n   a: 0,1,-3\n  }\n }\n"
        " Model: 200, \"Model::node\", \"Mesh\" {\n }\n Material: 300, \"Material::m\", \"\" {\n }\n"
        " Texture: 400, \"Texture::t\", \"\" {\n }\n"
        " Video: 500, \"Video::v\", \"Clip\" {\n  Type: \"Clip\"\n  Content: , \"AAAAAAAAA===\"\n }\n}\n"
        "Connections: {\n C: \"OO\",200,0\n C: \"OO\",100,200\n C: \"OO\",300,200\n"
        " C: \"OP\",400,300, \"DiffuseColor\"\n C: \"OO\",500,400\n}\n";
    const auto file = read_mesh({folder.write("a.fbx", text), {1, 1, 1}, "", false});
    if (file.ok())
        EXPECT_EQ(file.value().mesh.triangles.size(), 1u);
    else
        EXPECT_EQ(file.error().code, "reader-ended");
}

}  // namespace
}  // namespace roboss
