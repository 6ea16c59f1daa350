#include "renderer/data/load/node_file.h"

namespace volcast::data::load {

namespace {

Result<void> readNode(TextLines& lines, std::size_t i, NodeList& list) {
    const std::size_t attributes = list.attributes.size();
    auto done = lines.need(
        4 + attributes, "point " + std::to_string(i) + " of " + std::to_string(list.points.size()));
    if (!done) return done;
    const auto index = lines.integer(0);
    if (!index) return index.error();
    if (i == 0) list.first = *index;
    if (list.first < 0 || list.first > 1) return lines.error("the first point is neither 0 nor 1");
    if (*index != static_cast<std::int64_t>(i) + list.first) {
        return lines.error("point " + std::to_string(*index) + " stands where " +
                           std::to_string(static_cast<std::int64_t>(i) + list.first) +
                           " is expected");
    }
    for (int axis = 0; axis < 3; ++axis) {
        const auto value = lines.number(1 + static_cast<std::size_t>(axis));
        if (!value) return value.error();
        list.points[i][axis] = *value;
    }
    for (std::size_t a = 0; a < attributes; ++a) {
        const auto value = lines.value(4 + a);
        if (!value) return value.error();
        list.attributes[a].steps[0][i] = *value;
    }
    return {};
}

}  // namespace

Result<NodeList> readNodes(TextLines& lines) {
    auto done = lines.need(1, "the number of points");
    if (!done) return done.error();
    constexpr std::size_t kShortestLine = 8;  // "0 0 0 0\n"
    const auto count = lines.count(0, "points", kShortestLine);
    if (!count) return count.error();
    NodeList list;
    if (*count == 0) return list;
    const auto dimension = lines.words().size() > 1 ? lines.integer(1) : Result<std::int64_t>{3};
    if (!dimension) return dimension.error();
    if (*dimension != 3) {
        return lines.error("has " + std::to_string(*dimension) + " dimensions, 3 are needed");
    }
    std::size_t attributes = 0;
    if (lines.words().size() > 2) {
        const auto said = lines.count(2, "attributes", 2);
        if (!said) return said.error();
        attributes = *said;
        if (attributes > kMaxFields || attributes * *count > lines.bytes()) {
            return lines.error("says " + std::to_string(attributes) + " attributes of " +
                                   std::to_string(*count) + " points, which a file of " +
                                   std::to_string(lines.bytes()) + " bytes cannot hold",
                               ErrorCode::kLimitExceeded);
        }
    }
    for (std::string& name : attributeNames(lines.comments(), attributes, "value")) {
        list.attributes.push_back({.name = std::move(name),
                                   .association = Association::kVertex,
                                   .steps = {std::vector<double>(*count)},
                                   .times = {0.0}});
    }
    list.points.resize(*count);
    for (std::size_t i = 0; i < *count; ++i) {
        done = readNode(lines, i, list);
        if (!done) return done.error();
    }
    return list;
}

}  // namespace volcast::data::load
