#pragma once

#include <limits>

#include "renderer/reference/evaluate.h"
#include "renderer/scene/picked.h"

namespace volcast::pick {

/// What one layer shows on one ray, and the place that shows most of it.
struct Look {
    glm::dvec4 shown{0.0};  ///< Of the whole ray: premultiplied colour, opacity.
    scene::Picked place;    ///< Without the layer's id.
};

/// A place on a ray where a layer's matter is looked at.
struct Place {
    double distance = 0.0;
    double f = 0.0, g = 0.0;
    int item = -1;  ///< Cell or channel.
    glm::dvec3 colour{0.0};
    double extinction = 0.0;
    double through = 1.0;  ///< Transmittance from the eye to here.
};

/// How much `model` shows a place more than others: MIP the largest value, volumes the extinction
/// that is still seen, and so on. Of equal ones the nearest counts.
double weightOf(scene::RayModel model, const Place& place);

/// Whether nothing of a layer is seen where its strongest place has this weight.
bool showsNothing(scene::RayModel model, double weight);

/// Keeps the place of largest weight.
class Strongest {
public:
    explicit Strongest(scene::RayModel model) : model_{model} {}
    void add(const Place& place) {
        const double weight = weightOf(model_, place);
        if (!(weight > most_)) return;
        most_ = weight;
        place_ = place;
    }
    [[nodiscard]] bool found() const noexcept {
        return most_ > -std::numeric_limits<double>::infinity();
    }
    [[nodiscard]] const Place& place() const noexcept { return place_; }
    [[nodiscard]] double weight() const noexcept { return most_; }

private:
    scene::RayModel model_;
    double most_ = -std::numeric_limits<double>::infinity();
    Place place_;
};

}  // namespace volcast::pick
