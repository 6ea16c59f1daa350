#include "renderer/data/load/text_lines.h"

#include <cmath>

namespace volcast::data::load {

namespace {

constexpr std::string_view kBlank = " \t\r\f\v,";
constexpr std::size_t kMaxComments = 100;

void splitWords(std::string_view line, std::vector<std::string_view>& words) {
    words.clear();
    std::size_t at = line.find_first_not_of(kBlank);
    while (at != std::string_view::npos) {
        const std::size_t end = std::min(line.find_first_of(kBlank, at), line.size());
        words.push_back(line.substr(at, end - at));
        at = line.find_first_not_of(kBlank, end);
    }
}

/// A word as an error shows it: short, and printable.
std::string shown(std::string_view word) {
    std::string text{word.substr(0, 40)};
    for (char& c : text) {
        if (c < ' ' || c > '~') c = '?';
    }
    return "\"" + text + "\"";
}

template <class T>
bool parse(std::string_view word, T& value) {
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
    return code == std::errc{} && end == word.data() + word.size();
}

}  // namespace

bool TextLines::next() {
    while (position_ < text_.size()) {
        const std::size_t end = std::min(text_.find('\n', position_), text_.size());
        std::string_view line = text_.substr(position_, end - position_);
        position_ = end + 1;
        ++line_;
        const std::size_t hash = line.find('#');
        if (hash != std::string_view::npos) {
            if (comments_.size() < kMaxComments) comments_.push_back(line.substr(hash + 1));
            line = line.substr(0, hash);
        }
        splitWords(line, words_);
        if (!words_.empty()) return true;
    }
    words_.clear();
    return false;
}

Result<void> TextLines::need(std::size_t words, const std::string& what) {
    if (!next()) {
        return fail(ErrorCode::kInvalidArgument,
                    path_ + ": ends at line " + std::to_string(line_) + ", expected " + what);
    }
    if (words_.size() < words) {
        return error("has " + std::to_string(words_.size()) + " words, expected " +
                     std::to_string(words) + " (" + what + ")");
    }
    return {};
}

Result<double> TextLines::number(std::size_t i) const {
    auto number = value(i);
    if (number && std::isnan(*number)) return error(shown(words_[i]) + " is not finite");
    return number;
}

Result<double> TextLines::value(std::size_t i) const {
    double value = 0.0;
    if (i >= words_.size()) return error("word " + std::to_string(i + 1) + " is missing");
    if (!parse(words_[i], value)) return error(shown(words_[i]) + " is no number");
    if (std::isinf(value)) return error(shown(words_[i]) + " is not finite");
    return value;
}

Result<std::int64_t> TextLines::integer(std::size_t i) const {
    std::int64_t value = 0;
    if (i >= words_.size()) return error("word " + std::to_string(i + 1) + " is missing");
    if (!parse(words_[i], value)) return error(shown(words_[i]) + " is no whole number");
    return value;
}

Result<std::size_t> TextLines::count(std::size_t i, const char* what, std::size_t bytesEach) const {
    const auto value = integer(i);
    if (!value) return value.error();
    if (*value < 0) return error(std::to_string(*value) + " " + what);
    const auto items = static_cast<std::size_t>(*value);
    if (items > text_.size() / bytesEach + 1) {
        return error("says " + std::to_string(items) + " " + what + ", which a file of " +
                         std::to_string(text_.size()) + " bytes cannot hold",
                     ErrorCode::kLimitExceeded);
    }
    return items;
}

Error TextLines::error(const std::string& message, ErrorCode code) const {
    return fail(code, path_ + ": line " + std::to_string(line_) + ": " + message);
}

std::vector<std::string> attributeNames(const std::vector<std::string_view>& comments,
                                        std::size_t count, const std::string& single) {
    constexpr std::string_view kMark = "attributes:";
    std::vector<std::string_view> words;
    for (const std::string_view comment : comments) {
        const std::size_t mark = comment.find(kMark);
        if (mark == std::string_view::npos) continue;
        splitWords(comment.substr(mark + kMark.size()), words);
        if (words.size() == count) return {words.begin(), words.end()};
    }
    if (count == 1) return {single};
    std::vector<std::string> names;
    for (std::size_t i = 0; i < count; ++i) names.push_back("attribute_" + std::to_string(i));
    return names;
}

}  // namespace volcast::data::load
