#pragma once

#include <vector>

#include "renderer/base/result.h"
#include "renderer/scene/scene.h"

namespace volcast::scene {

/// A scale over a known domain: what turns values into those that rays interpolate.
///
/// kLinear is v, kLog is log(v), kPower ((v - min)/(max - min))^p; values far from 0 beside the
/// width of their domain are taken relative to its lower end, as coordinates are relative to an
/// origin: float32 keeps 6e-8 of the number, not of the range. Monotone; computed in double,
/// rounded once.
class ScaleFunction {
public:
    /// `range` is the field's, for a scale without a domain.
    ScaleFunction(const Scale& scale, const data::Range& range);

    /// True where values stay as they are, so that nothing has to be applied.
    [[nodiscard]] bool identity() const noexcept { return identity_; }
    /// A stored value, clamped to the domain first.
    [[nodiscard]] float ofData(float value) const;
    /// A control point, level or interval end; may lie outside the domain. kLog: must be > 0.
    [[nodiscard]] float ofPoint(float value) const;
    [[nodiscard]] data::Range domain() const noexcept { return domain_; }

private:
    Scale::Kind kind_;
    double exponent_;
    data::Range domain_;
    double offset_;  ///< Taken off kLinear values.
    bool identity_;
};

/// `map` with its values as rays see them.
data::TransferFunction scaled(const data::TransferFunction& map, const ScaleFunction& scale);

/// The levels in the field's unit, ascending, each once. `levels` must be valid.
std::vector<float> resolved(const Levels& levels);

/// Those of an isosurface's levels that its interval lets through, ends included.
std::vector<float> levelsOf(const Layer& layer);

/// Checks a scale against the range of its field: kLog needs a domain above 0, kPower an exponent
/// above 0, a domain is finite with min < max.
///
/// Errors: kInvalidArgument, `field` = `path` + ".domain" or ".exponent".
Result<void> validate(const Scale& scale, const data::Range& range, const std::string& path);

/// Errors: kInvalidArgument (no level, not finite, kLog ends not above 0, exponent not above 0),
/// kLimitExceeded (more than Levels::kMaxLevels), with `field` below `path`.
Result<void> validate(const Levels& levels, const std::string& path);

}  // namespace volcast::scene
