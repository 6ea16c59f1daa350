#include "server/net/negotiation.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

namespace volcast::net {

namespace {

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// What stands before `mark`, which is taken off `text` with it; all of it where there is none.
std::string_view takeUntil(std::string_view& text, char mark) {
    const auto end = text.find(mark);
    const std::string_view part = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    return trimmed(part);
}

bool sameText(std::string_view a, std::string_view b) {
    return std::ranges::equal(
        a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// Of parameters such as "q=0.5"; 1 where there is none, 0 for what is no number.
double weightOf(std::string_view parameters) {
    while (!parameters.empty()) {
        std::string_view one = takeUntil(parameters, ';');
        if (!sameText(takeUntil(one, '='), "q")) continue;
        double weight = 0.0;
        std::from_chars(one.data(), one.data() + one.size(), weight);
        return weight;
    }
    return 1.0;
}

}  // namespace

bool acceptsGzip(std::string_view acceptEncoding) {
    std::optional<bool> gzip;
    bool any = false;
    while (!acceptEncoding.empty()) {
        std::string_view item = takeUntil(acceptEncoding, ',');
        const std::string_view coding = takeUntil(item, ';');
        const bool wanted = weightOf(item) > 0.0;
        if (sameText(coding, "gzip") || sameText(coding, "x-gzip")) gzip = wanted;
        if (coding == "*") any = wanted;
    }
    return gzip.value_or(any);
}

bool namesEtag(std::string_view ifNoneMatch, std::string_view etag) {
    while (!ifNoneMatch.empty()) {
        std::string_view one = takeUntil(ifNoneMatch, ',');
        if (one.starts_with("W/")) one.remove_prefix(2);
        if (one == "*" || one == etag) return true;
    }
    return false;
}

}  // namespace volcast::net
