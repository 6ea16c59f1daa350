// Several layers in one picture: meshes in voxels, rays that end at surfaces, the order of layers.
#include <array>
#include <cmath>

#include "tests/support/mesh_scenes.h"
#include "tests/support/phantoms.h"
#include "tests/support/render_test.h"

namespace volcast {
namespace {

using scene::Projection;
using scene::RayModel;

/// One tetrahedron whose face z = `z` covers the view, its tip behind it.
data::MeshInput wedge(double z) {
    data::MeshInput input;
    input.points = {{-50, -50, z}, {50, -50, z}, {0, 70, z}, {0, 0, z - 3}};
    input.cells = {{0, 1, 2, 3}};
    return input;
}

class Layers : public support::MeshTest {
protected:
    Layers() {
        renderer_->addDataset("fog", support::volumeOf({.size = {9, 9, 9}, .origin = {-4, -4, 0}},
                                                       [](const auto&) { return 1.0; }));
        scene_.camera = {.eye = {0.1, 0.2, 30}, .center = {0.1, 0.2, 0}};
        scene_.camera.projection = Projection::kOrthographic;
        scene_.camera.orthographicHeight = 4.0;
        scene::Layer fog;
        fog.id = "fog";
        fog.dataset = "fog";
        fog.map = support::fog(0.25F);
        scene_.layers.push_back(fog);
    }

    void addSurface(const std::string& dataset, const glm::vec3& colour) {
        scene::Layer surface;
        surface.id = "surface of " + dataset;
        surface.dataset = dataset;
        surface.model = RayModel::kSurface;
        surface.headlight = false;
        surface.surfaceColour = colour;
        scene_.layers.push_back(surface);
    }

    /// White fog of extinction 1/4 and `length` before `behind`.
    static void expectFog(const glm::vec4& pixel, double length, const glm::vec3& behind) {
        const double through = std::exp(-0.25 * length);
        EXPECT_NEAR(pixel.r, 1 - through + through * behind.r, 2e-5);
        EXPECT_NEAR(pixel.g, 1 - through + through * behind.g, 2e-5);
        EXPECT_NEAR(pixel.b, 1 - through + through * behind.b, 2e-5);
        EXPECT_NEAR(pixel.a, 1.0, 2e-6);
    }

    scene::Scene scene_;
};

TEST_F(Layers, RaysOfAVolumeEndAtASurfaceWithinIt) {
    use(wedge(2.75));
    addSurface("mesh", {0.1F, 0.5F, 0.2F});
    for (const bool perspective : {false, true}) {
        scene_.camera.projection =
            perspective ? Projection::kPerspective : Projection::kOrthographic;
        scene_.camera.fovyDegrees = 5.0;
        const auto picture = draw(scene_, {8, 8});
        for (const glm::ivec2 pixel : {glm::ivec2{0, 0}, {4, 4}, {7, 2}}) {
            const double slope = std::tan(2.5 * 3.14159265358979323846 / 180.0) / 8.0;
            const glm::dvec2 away =
                perspective ? slope * (2.0 * glm::dvec2(pixel) - 7.0) : glm::dvec2(0.0);
            const double slant = std::sqrt(1.0 + glm::dot(away, away));
            expectFog(picture.at(pixel.x, pixel.y), (8.0 - 2.75) * slant, {0.1F, 0.5F, 0.2F});
        }
    }
}

// Six planes make a box, of voxels and of cells alike.
TEST_F(Layers, ABoxCutsAMeshAndAVolumeInOneView) {
    renderer_->addDataset("wedge", support::must(data::buildMesh(wedge(2.0))));
    addSurface("wedge", {0.5F, 0.25F, 0.125F});
    const auto box = [](double back) {
        return std::vector<scene::ClipPlane>{
            {.normal = {1, 0, 0}, .offset = -1},   {.normal = {-1, 0, 0}, .offset = -1},
            {.normal = {0, 1, 0}, .offset = -1},   {.normal = {0, -1, 0}, .offset = -1},
            {.normal = {0, 0, 1}, .offset = back}, {.normal = {0, 0, -1}, .offset = -3.5}};
    };
    scene_.clipPlanes = box(1.0);
    // Pixels are 4 / 9 wide: the one in the middle lies in the box, those at the edges beside it.
    auto picture = draw(scene_, {9, 9});
    expectFog(picture.at(4, 4), 1.5, {0.5F, 0.25F, 0.125F});
    for (const glm::ivec2 beside : {glm::ivec2{0, 4}, {8, 4}, {4, 0}, {4, 8}}) {
        EXPECT_EQ(picture.at(beside.x, beside.y), glm::vec4(0.0F)) << beside.x << ' ' << beside.y;
    }
    // The box begins in front of the surface: fog alone is left.
    scene_.clipPlanes = box(2.2);
    picture = draw(scene_, {9, 9});
    EXPECT_NEAR(picture.at(4, 4).a, -std::expm1(-0.25 * 1.3), 2e-5);
    EXPECT_NEAR(picture.at(4, 4).b, picture.at(4, 4).a, 2e-5);
}

TEST_F(Layers, ASurfaceInFrontHidesTheVolumeAndOneBehindDoesNot) {
    use(wedge(12.0));
    addSurface("mesh", {0.1F, 0.5F, 0.2F});
    EXPECT_NEAR(draw(scene_, {4, 4}).at(1, 1).g, 0.5, 1e-6);
    use(wedge(-5.0));
    expectFog(draw(scene_, {4, 4}).at(1, 1), 8.0, {0.1F, 0.5F, 0.2F});
}

TEST_F(Layers, TheNearerOfTwoSurfacesIsSeenWhateverTheirOrder) {
    use(wedge(3.0));
    renderer_->addDataset("nearer", support::must(data::buildMesh(wedge(5.0))));
    addSurface("nearer", {1, 0, 0});
    addSurface("mesh", {0, 0, 1});
    expectFog(draw(scene_, {4, 4}).at(1, 1), 3.0, {1, 0, 0});
    std::swap(scene_.layers[1], scene_.layers[2]);
    expectFog(draw(scene_, {4, 4}).at(1, 1), 3.0, {1, 0, 0});
    scene_.layers[2].visible = false;
    expectFog(draw(scene_, {4, 4}).at(1, 1), 5.0, {0, 0, 1});
}

TEST_F(Layers, TheLastLayerLiesOnTop) {
    scene::Layer mip = scene_.layers[0];
    mip.id = "mip";
    mip.model = RayModel::kMip;
    mip.map = support::constantMap({0, 0.5F, 0}, 0.0F);
    scene_.layers.push_back(mip);
    EXPECT_EQ(draw(scene_, {4, 4}).at(1, 1), glm::vec4(0, 0.5F, 0, 1)) << "a mip is opaque";
    std::swap(scene_.layers[0], scene_.layers[1]);
    expectFog(draw(scene_, {4, 4}).at(1, 1), 8.0, {0, 0.5F, 0});
}

TEST_F(Layers, ASceneWithoutLayersIsItsBackground) {
    scene_.layers.clear();
    scene_.background = {1.0F, 0.0F, 0.0F, 1.0F};
    const auto picture = draw(scene_, {4, 4});
    EXPECT_EQ(picture.at(2, 2), glm::vec4(0.0F));
    EXPECT_EQ(picture.byteAt(2, 2), glm::ivec4(255, 0, 0, 255));
}

}  // namespace
}  // namespace volcast
