#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "renderer/scene/channels.h"
#include "tests/support/volume_reference.h"

namespace volcast::support {

/// What a ray through several channels shows, in double, and how far float32 may be from it.
///
/// A picture is wrong by what its samples are: positions are off by 2^-22 of the grid units between
/// the eye and the data, values between voxels by a part of the largest. So each sample is looked
/// at with all values that it may have, near it and between: what is emitted and absorbed by any of
/// them differs by some amount, which is added up over the ray. That follows steps of maps, ends of
/// intervals, walls between nearest voxels, and light where the field is nearly flat.
class ChannelSums {
public:
    struct Shown {
        glm::dvec4 pixel{0.0};
        double off = 0.0;
    };

    /// Parts of the largest value that interpolated ones are off by: what filtersExactly() allows
    /// a texture unit. In a shader three sums of two products are rounded by 2^-24 thrice each;
    /// tricubic sums by 24 times that, of weights whose sizes add up to 2 at most.
    static constexpr double kTextureUnit = 4e-6, kTrilinear = 9.0 / (1 << 24),
                            kTricubic = 48.0 / (1 << 24);

    /// `alone`: a volume for each of the layer's channels. Keeps references.
    ChannelSums(const scene::Layer& layer, const std::vector<data::Volume>& alone, double gridToEye,
                double interpolation)
        : layer_{layer}, away_{gridToEye / (1 << 22)} {
        for (std::size_t i = 0; i < layer.channels.size(); ++i) {
            if (!layer.channels[i].visible) continue;
            const data::Range range = alone[i].channels[0].range;
            const double most = std::max(std::abs(range.min), std::abs(range.max));
            channels_.push_back({.shown = &layer.channels[i],
                                 .field = VolumeReference{alone[i], layer.sampling},
                                 .most = most,
                                 .noise = interpolation * most,
                                 .spacing = std::min({alone[i].spacing.x, alone[i].spacing.y,
                                                      alone[i].spacing.z})});
        }
    }

    [[nodiscard]] Shown of(const ReferenceRay& ray) const {
        const glm::dvec2 span = channels_.front().field.span(ray);
        const bool xray = layer_.model == scene::RayModel::kXray;
        if (span.x > span.y) return {.pixel = glm::dvec4(xray ? 1.0 : 0.0)};
        const double samples = std::max(std::ceil((span.y - span.x) / layer_.stepWorld), 1.0);
        const double dt = (span.y - span.x) / samples;
        if (layer_.model == scene::RayModel::kMip || layer_.model == scene::RayModel::kMinip) {
            return extremes(ray, static_cast<int>(samples));
        }
        glm::dvec3 colour{0.0};
        double depth = 0.0, off = 0.0, depthOff = 0.0;
        for (int i = 0; i < static_cast<int>(samples); ++i) {
            glm::dvec3 emission{0.0};
            double extinction = 0.0;
            for (const Channel& channel : channels_) {
                const Sample sample = sampleOf(channel, ray, span.x + (i + 0.5) * dt);
                emission += sample.emission;
                extinction += sample.extinction;
                // What is absorbed more hides as much of all that lies behind.
                off += std::exp(-depth) * dt *
                       (sample.emissionOff + brightest() * sample.extinctionOff);
                depthOff += dt * sample.extinctionOff;
            }
            if (extinction > 0.0) {
                colour += std::exp(-depth) * -std::expm1(-extinction * dt) * emission / extinction;
            }
            depth += extinction * dt;
        }
        if (!xray) return {.pixel = {colour, -std::expm1(-depth)}, .off = off};
        const double light = std::exp(-layer_.extinctionScale * depth);
        return {.pixel = {glm::dvec3(light), 1.0}, .off = layer_.extinctionScale * depthOff};
    }

private:
    struct Channel {
        const scene::ChannelMap* shown;
        VolumeReference field;
        double most;     ///< Size of its largest value.
        double noise;    ///< Of a value between voxels.
        double spacing;  ///< The least.
    };
    struct Sample {
        glm::dvec3 emission{0.0};
        double extinction = 0.0, emissionOff = 0.0, extinctionOff = 0.0;
    };

    /// Of all colours under the light.
    [[nodiscard]] double brightest() const {
        if (!layer_.light) return 1.0;
        return double{layer_.light->ambient} + layer_.light->diffuse + layer_.light->specular;
    }

    [[nodiscard]] glm::dvec4 matterOf(const Channel& channel, double value) const {
        const auto& interval = channel.shown->interval;
        if (interval && !(value >= interval->min && value <= interval->max)) return glm::dvec4(0.0);
        glm::dvec4 matter = VolumeReference::matterOf(value, channel.shown->map);
        if (layer_.model == scene::RayModel::kVolume) matter.a *= std::exp(double{layer_.gain});
        return matter;
    }

    /// How far the light on a sample may be off, as parts of its colour and of white together.
    ///
    /// A slope is a difference over at least one interval of two values, each off by `valueOff`:
    /// along three axes it turns by at most sqrt(3) 2 valueOff / spacing of its own length. Places
    /// of these values are rounded once more, at up to 32 grid units; no field of the tests rises
    /// by more than half of its largest value an interval.
    [[nodiscard]] double lightOff(const Channel& channel, const glm::dvec3& at) const {
        const double valueOff = channel.noise + 0.5 * channel.most * 32 / (1 << 24);
        const double slope = glm::length(channel.field.slopeAt(at));
        const double turn = std::sqrt(3.0) * 2.0 * valueOff / channel.spacing / slope;
        const double most = double{layer_.light->diffuse} + layer_.light->specular;
        const double steepest =
            double{layer_.light->diffuse} + double{layer_.light->specular} * layer_.light->exponent;
        return slope > 0.0 ? std::min(most, steepest * turn) : most;
    }

    [[nodiscard]] Sample sampleOf(const Channel& channel, const ReferenceRay& ray,
                                  double distance) const {
        const glm::dvec3 at = ray.eye + distance * ray.direction;
        const double value = channel.field.valueAt(at);
        const glm::dvec2 near = channel.field.valuesNear(at, away_);
        const glm::dvec4 matter = matterOf(channel, value);
        const auto emitted = [&](const glm::dvec4& m, double off = 0.0) {
            const glm::dvec3 colour{m};
            if (!layer_.light) return m.a * colour;
            return m.a *
                   channel.field.lit(colour, *layer_.light, at + glm::dvec3(off), ray.direction);
        };
        Sample sample{.emission = emitted(matter), .extinction = matter.a};
        for (const double other : {near.x - channel.noise, near.y + channel.noise}) {
            const glm::dvec4 m = matterOf(channel, other);
            const glm::dvec3 off = glm::abs(emitted(m) - sample.emission);
            sample.emissionOff = std::max({sample.emissionOff, off.r, off.g, off.b});
            sample.extinctionOff = std::max(sample.extinctionOff, std::abs(m.a - matter.a));
        }
        if (!layer_.light || matter.a == 0.0) return sample;
        double turned = 0.0;  // By the place of the sample.
        for (const double off : {-away_ * channel.spacing, away_ * channel.spacing}) {
            const glm::dvec3 by = glm::abs(emitted(matter, off) - sample.emission);
            turned = std::max({turned, by.r, by.g, by.b});
        }
        sample.emissionOff += turned + matter.a * lightOff(channel, at);
        return sample;
    }

    /// Colours of each channel's extreme, added up.
    [[nodiscard]] Shown extremes(const ReferenceRay& ray, int samples) const {
        Shown shown{.pixel = {0.0, 0.0, 0.0, 1.0}};
        for (const Channel& channel : channels_) {
            const auto values = channel.field.valuesOn(ray, samples);
            const auto [low, high] = std::ranges::minmax(values);
            const double value = layer_.model == scene::RayModel::kMip ? high : low;
            const glm::dvec4 matter = matterOf(channel, value);
            shown.pixel += glm::dvec4(glm::dvec3(matter), 0.0);
            const double noise = channel.noise + 0.5 * channel.most * away_;  // As above.
            for (const double other : {value - noise, value + noise}) {
                const glm::dvec4 off = glm::abs(matterOf(channel, other) - matter);
                shown.off += std::max({off.r, off.g, off.b});
            }
        }
        return shown;
    }

    const scene::Layer& layer_;
    double away_;  ///< Of positions, grid units.
    std::vector<Channel> channels_;
};

}  // namespace volcast::support
