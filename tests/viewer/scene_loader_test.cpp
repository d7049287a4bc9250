// SPDX-License-Identifier: MIT
// Requests for scenes, and the answers of the thread that reads them.
#include "fixtures/temporary_folder.h"
#include "metamarch/error/error.h"
#include "metamarch/viewer/scene_loader.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace metamarch::viewer {
namespace {

using namespace std::chrono_literals;

// Writes a file with triangles side by side. Each is a separate mesh.
std::filesystem::path makeScene(const TemporaryFolder& folder, const std::string& name, const int triangles) {
    std::filesystem::path path = folder / name;
    std::ofstream file(path);
    for (int i = 0; i < triangles; ++i) {
        file << "o mesh" << i << "\nv " << 2 * i << " 0 0\nv " << 2 * i + 1 << " 0 0\nv " << 2 * i << " 1 0\n"
             << "f -3 -2 -1\n";
    }
    return path;
}

SceneRequest requestOf(const std::filesystem::path& file) {
    SceneRequest request;
    request.file = file;
    request.light.kind = LightChoice::Kind::background;
    request.light.background = glm::vec3(1.0f);
    return request;
}

// Returns all answers until the loader has nothing left to do.
std::vector<SceneLoader::Answer> answers(SceneLoader& loader) {
    std::vector<SceneLoader::Answer> all;
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (loader.isBusy() && std::chrono::steady_clock::now() < end) {
        if (auto answer = loader.take()) {
            all.push_back(*answer);
        } else {
            std::this_thread::sleep_for(1ms);
        }
    }
    return all;
}

TEST(SceneLoader, isAtTheFirstStageOfTheLastRequest) {
    const TemporaryFolder folder;
    SceneLoader loader;
    const SceneRequest first = requestOf(makeScene(folder, "first.obj", 1));
    loader.ask(first);
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (loader.stage() != LoadStage::uploading && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(1ms);
    }
    EXPECT_EQ(loader.stage(), LoadStage::uploading); // waits for who takes it
    ASSERT_TRUE(loader.take());
    loader.ask(requestOf(makeScene(folder, "second.obj", 20'000)));
    EXPECT_EQ(loader.stage(), LoadStage::reading);
}

std::shared_ptr<const LoadedScene> load(SceneLoader& loader, const SceneRequest& request) {
    loader.ask(request);
    const std::vector<SceneLoader::Answer> all = answers(loader);
    EXPECT_EQ(all.size(), 1u);
    if (all.empty() || !all.back().scene) {
        throw std::runtime_error(all.empty() ? "no answer" : all.back().refusal->what());
    }
    return all.back().scene;
}

TEST(SceneLoader, isIdleUntilItIsAsked) {
    SceneLoader loader;
    EXPECT_FALSE(loader.isBusy());
    EXPECT_FALSE(loader.take().has_value());
}

TEST(SceneLoader, readsBuildsAndLights) {
    const TemporaryFolder folder;
    SceneLoader loader;
    const auto scene = load(loader, requestOf(makeScene(folder, "two.obj", 2)));
    EXPECT_EQ(scene->whole->triangles.size(), 2u);
    EXPECT_EQ(scene->whole, scene->shown.scene);
    EXPECT_EQ(scene->shown.structure->triangles.size(), scene->shown.structure->tree.leafTriangles.size());
    EXPECT_EQ(scene->bounds.hi, glm::vec3(3, 1, 0));
    EXPECT_FALSE(loader.isBusy());
}

TEST(SceneLoader, sharesWhatARequestDoesNotChange) {
    const TemporaryFolder folder;
    SceneLoader loader;
    SceneRequest request = requestOf(makeScene(folder, "two.obj", 2));
    const auto first = load(loader, request);

    request.light.background = glm::vec3(2.0f);
    const auto relit = load(loader, request);
    EXPECT_EQ(relit->whole, first->whole);
    EXPECT_EQ(relit->shown.structure, first->shown.structure);

    request.hiddenMeshes = {1};
    const auto less = load(loader, request);
    EXPECT_EQ(less->whole, first->whole);
    EXPECT_NE(less->shown.structure, first->shown.structure);
    EXPECT_EQ(less->shown.scene->triangles.size(), 1u);
    EXPECT_EQ(less->shown.scene->triangleMesh, std::vector<std::uint32_t>{0});
    EXPECT_EQ(less->bounds.hi,
              glm::vec3(3, 1, 0)); // the bounds are those of the whole scene, so the camera stays

    request.reading = 1;
    const auto again = load(loader, request);
    EXPECT_NE(again->whole, first->whole);
}

TEST(SceneLoader, answersTheNewestRequestLast) {
    const TemporaryFolder folder;
    const auto one = makeScene(folder, "one.obj", 1);
    const auto two = makeScene(folder, "two.obj", 2);
    SceneLoader loader;
    for (int i = 0; i < 20; ++i) {
        loader.ask(requestOf(one));
        loader.ask(requestOf(folder / "missing.obj"));
        loader.ask(requestOf(two));
        const std::vector<SceneLoader::Answer> all = answers(loader);
        ASSERT_GE(all.size(), 1u);
        ASSERT_LE(all.size(), 3u);
        ASSERT_TRUE(all.back().scene);
        EXPECT_EQ(all.back().scene->request.file, two);
        EXPECT_FALSE(loader.take().has_value());
    }
}

TEST(SceneLoader, saysWhyThereIsNoScene) {
    const TemporaryFolder folder;
    SceneLoader loader;
    const auto good = requestOf(makeScene(folder, "one.obj", 1));
    const auto first = load(loader, good);

    loader.ask(requestOf(folder / "missing.obj"));
    std::vector<SceneLoader::Answer> all = answers(loader);
    ASSERT_EQ(all.size(), 1u);
    EXPECT_FALSE(all[0].scene);
    ASSERT_TRUE(all[0].refusal);
    EXPECT_TRUE(std::string(all[0].refusal->what()).ends_with("missing.obj: no such file"))
        << all[0].refusal->what();
    EXPECT_EQ(all[0].refusal->kind, ErrorKind::inputRefused);

    SceneRequest unlit = good;
    unlit.light.kind = LightChoice::Kind::map;
    unlit.light.map = folder / "missing.hdr";
    loader.ask(unlit);
    all = answers(loader);
    ASSERT_EQ(all.size(), 1u);
    EXPECT_FALSE(all[0].scene);
    ASSERT_TRUE(all[0].refusal);
    EXPECT_NE(std::string(all[0].refusal->what()).find("missing.hdr"), std::string::npos);

    // A refused request does not discard the last scene.
    EXPECT_EQ(load(loader, good)->whole, first->whole);
}

TEST(SceneLoader, leavesTheLastStageToTheTaker) {
    const TemporaryFolder folder;
    const auto good = requestOf(makeScene(folder, "one.obj", 1));
    for (const bool isRefused : {false, true, false}) {
        SceneLoader loader;
        EXPECT_FALSE(loader.hasRefused());
        loader.ask(isRefused ? requestOf(folder / "missing.obj") : good);
        while (loader.stage() != LoadStage::uploading && !loader.hasRefused()) {
            std::this_thread::sleep_for(1ms);
        }
        EXPECT_TRUE(loader.isBusy());
        EXPECT_EQ(loader.hasRefused(), isRefused);
        EXPECT_EQ(answers(loader).size(), 1u);
        EXPECT_FALSE(loader.hasRefused());
    }
}

TEST(SceneLoader, endsWithItsWorkUnderWay) {
    const TemporaryFolder folder;
    const auto file = makeScene(folder, "many.obj", 2000);
    for (int i = 0; i < 5; ++i) {
        SceneLoader loader;
        loader.ask(requestOf(file));
    }
}

} // namespace
} // namespace metamarch::viewer
