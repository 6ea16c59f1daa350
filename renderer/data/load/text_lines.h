#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/base/result.h"

namespace volcast::data::load {

/// Walks the lines of a text that have words on them; `#` starts a comment.
class TextLines {
public:
    /// `path` is only named in errors; `text` must outlive this.
    TextLines(std::string path, std::string_view text) : path_{std::move(path)}, text_{text} {}

    /// Moves to the next line with words; false at the end.
    bool next();
    [[nodiscard]] const std::vector<std::string_view>& words() const noexcept { return words_; }
    [[nodiscard]] std::size_t line() const noexcept { return line_; }
    [[nodiscard]] std::size_t bytes() const noexcept { return text_.size(); }
    /// The comments passed so far, one a line, without their `#`.
    [[nodiscard]] const std::vector<std::string_view>& comments() const noexcept {
        return comments_;
    }

    /// The next line, which must have at least `words` words. Errors: kInvalidArgument.
    Result<void> need(std::size_t words, const std::string& what);

    /// Word `i` as a finite number. Errors: kInvalidArgument naming path and line.
    Result<double> number(std::size_t i) const;
    /// The same for the value of a field, which may be NaN.
    Result<double> value(std::size_t i) const;
    Result<std::int64_t> integer(std::size_t i) const;
    /// A count of items that take at least `bytesEach` bytes of text each.
    ///
    /// Errors: kInvalidArgument, kLimitExceeded (more than this text can hold).
    Result<std::size_t> count(std::size_t i, const char* what, std::size_t bytesEach) const;

    /// `code` and `message` with path and line in front.
    [[nodiscard]] Error error(const std::string& message,
                              ErrorCode code = ErrorCode::kInvalidArgument) const;

private:
    std::string path_;
    std::string_view text_;
    std::size_t position_ = 0;
    std::size_t line_ = 0;
    std::vector<std::string_view> words_;
    std::vector<std::string_view> comments_;
};

/// Names from a comment "attributes: a b", else "attribute_0" and so on (one alone: `single`).
std::vector<std::string> attributeNames(const std::vector<std::string_view>& comments,
                                        std::size_t count, const std::string& single);

}  // namespace volcast::data::load
