#include "tests/support/numerics/psi_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <string_view>

namespace volcast::support {
namespace {

constexpr std::array<std::string_view, 5> kColumns{"tau_f_D", "tau_b_D", "zeta", "w_front",
                                                   "w_back"};

std::vector<std::string_view> cellsOf(std::string_view line) {
    if (line.ends_with('\r')) line.remove_suffix(1);
    std::vector<std::string_view> cells;
    while (true) {
        const std::size_t comma = line.find(',');
        cells.push_back(line.substr(0, comma));
        if (comma == std::string_view::npos) return cells;
        line.remove_prefix(comma + 1);
    }
}

Error atLine(const std::string& path, int line, const std::string& what) {
    return fail(ErrorCode::kInvalidArgument, path + ":" + std::to_string(line) + ": " + what);
}

/// A finite number >= 0; NaN where `text` is none.
double numberOf(std::string_view text) {
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool whole = end == text.data() + text.size();
    // What is too small for a double is 0.
    if (error == std::errc::result_out_of_range && whole && std::abs(number) < 1.0) return 0.0;
    if (error != std::errc{} || !whole || !std::isfinite(number) || number < 0.0) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    return number;
}

}  // namespace

Result<std::vector<PsiRow>> readPsiFile(const std::string& path) {
    std::ifstream file{path};
    std::string text;
    if (!file || !std::getline(file, text)) {
        return fail(ErrorCode::kIo, path + ": cannot be read, or has no line");
    }
    const std::vector<std::string_view> names = cellsOf(text);
    std::array<std::size_t, kColumns.size()> place{};
    for (std::size_t c = 0; c < kColumns.size(); ++c) {
        const auto found = std::find(names.begin(), names.end(), kColumns[c]);
        if (found == names.end()) {
            return atLine(path, 1,
                          "no column " + std::string{kColumns[c]} +
                              "; needs tau_f_D, tau_b_D, zeta, w_front, w_back");
        }
        place[c] = static_cast<std::size_t>(found - names.begin());
    }
    const std::size_t width = names.size();
    std::vector<PsiRow> rows;
    for (int line = 2; std::getline(file, text); ++line) {
        if (text.empty() || text == "\r") continue;
        const std::vector<std::string_view> cells = cellsOf(text);
        if (cells.size() != width) {
            return atLine(
                path, line,
                std::to_string(cells.size()) + " columns, expected " + std::to_string(width));
        }
        std::array<double, kColumns.size()> numbers{};
        for (std::size_t c = 0; c < kColumns.size(); ++c) {
            numbers[c] = numberOf(cells[place[c]]);
            const double limit = c < 2 ? std::numeric_limits<float>::max() : 1.000001;
            if (!(numbers[c] <= limit)) {
                return atLine(path, line,
                              std::string{kColumns[c]} + " is \"" + std::string{cells[place[c]]} +
                                  "\", expected a number in [0, " + (c < 2 ? "3.4e38]" : "1]"));
            }
        }
        rows.push_back({.a = static_cast<float>(numbers[0]),
                        .b = static_cast<float>(numbers[1]),
                        .zeta = numbers[2],
                        .front = numbers[3],
                        .back = numbers[4],
                        .line = line});
    }
    if (rows.empty()) return atLine(path, 1, "no rows below the names of the columns");
    return rows;
}

}  // namespace volcast::support
