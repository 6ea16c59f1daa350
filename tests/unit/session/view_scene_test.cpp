#include "server/session/view_scene.h"

#include <gtest/gtest.h>

#include "tests/unit/session/scripted_render.h"

namespace volcast::session {
namespace {

/// Both demo datasets, of one byte each, where one byte may be loaded.
class ViewSceneData : public testing::Test {
protected:
    void SetUp() override {
        CatalogueDesc desc;
        desc.importer = test::importCube;
        desc.maxDataBytes = 1;
        catalogue = *Catalogue::create(std::move(desc), render);
    }
    bool load(const std::string& id) {
        EXPECT_TRUE(catalogue->require(id).has_value());
        while (!catalogue->standing(id).loaded && !catalogue->standing(id).failed) {
            std::this_thread::yield();
        }
        return catalogue->standing(id).loaded;
    }
    static v1::OpenView opening(const std::string& id) {
        v1::OpenView open;
        open.set_dataset(id);
        return open;
    }
    test::ScriptedRender render;
    std::unique_ptr<Catalogue> catalogue;
};

TEST_F(ViewSceneData, WhatAViewShowsStaysLoadedUntilTheViewEnds) {
    ASSERT_TRUE(load("demo:mesh"));
    {
        ViewScene view{*catalogue};
        EXPECT_EQ(*view.open(opening("demo:mesh")), SceneChange::kDraw);
        EXPECT_FALSE(load("demo:volume"));
        EXPECT_TRUE(catalogue->standing("demo:mesh").loaded);
    }
    EXPECT_TRUE(load("demo:volume"));
    EXPECT_FALSE(catalogue->standing("demo:mesh").loaded);
}

TEST_F(ViewSceneData, WhatAViewWaitsForStaysOnceItIsThere) {
    ViewScene view{*catalogue};
    EXPECT_EQ(*view.open(opening("demo:mesh")), SceneChange::kWaiting);
    ASSERT_TRUE(load("demo:mesh"));
    EXPECT_FALSE(load("demo:volume"));
    EXPECT_EQ(*view.datasetChanged("demo:mesh"), SceneChange::kDraw);
    EXPECT_FALSE(load("demo:volume"));
}

// Gone back to after a failure, without being asked for again.
TEST_F(ViewSceneData, TheLastSceneThatWasDrawnStaysToo) {
    ASSERT_TRUE(load("demo:mesh"));
    ViewScene view{*catalogue};
    ASSERT_TRUE(view.open(opening("demo:mesh")).has_value());
    view.drawn(1);
    scene::Scene empty = *view.scene();
    empty.layers.clear();
    ASSERT_TRUE(view.put(empty, 2).has_value());
    EXPECT_FALSE(load("demo:volume"));
    EXPECT_TRUE(view.revert().has_value());
    EXPECT_TRUE(catalogue->standing("demo:mesh").loaded);
}

}  // namespace
}  // namespace volcast::session
