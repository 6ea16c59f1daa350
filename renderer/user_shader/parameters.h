#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/user_shader/control.h"
#include "renderer/user_shader/directive.h"

namespace volcast::user_shader {

/// The parameters of one directive, read by name and kind; what is wrong becomes a complaint.
class Parameters {
public:
    Parameters(const Directive& directive, std::vector<Complaint>& complaints)
        : directive_{directive}, complaints_{complaints} {}

    /// Complains of parameters that are not in `names`.
    void allow(std::initializer_list<std::string_view> names);
    /// Complains of a type that is not in `types`.
    void requireType(std::initializer_list<std::string_view> types);

    /// Nothing where it is not given; nothing and a complaint where it is of another kind.
    [[nodiscard]] const Parameter* find(std::string_view name) const;
    std::optional<double> number(std::string_view name, NumberType type);
    std::optional<bool> flag(std::string_view name);
    std::optional<glm::vec3> colour(std::string_view name);
    std::optional<int> channel(std::string_view name);
    std::optional<Interval> interval(std::string_view name, bool ordered);

    void complain(const Parameter& parameter, std::string message);
    /// Of the directive as a whole.
    void complain(std::string message);
    [[nodiscard]] const Directive& directive() const { return directive_; }

private:
    const Directive& directive_;
    std::vector<Complaint>& complaints_;
};

/// A JSON number as such; nothing for other values.
std::optional<double> numberOf(const boost::json::value& value);
/// Why `value` cannot be a `type`: "an integer", ...; null where it can.
const char* unfit(double value, NumberType type);
/// As a user would write it: 0.5, 3.
std::string textOf(double value);

}  // namespace volcast::user_shader
