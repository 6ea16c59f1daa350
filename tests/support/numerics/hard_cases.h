#pragma once

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

/// The rows of hard_cases.csv (columns: README.md of this folder).
namespace volcast::support {

using Row = std::vector<std::string>;  // kind, name, input, correct, tolerance, why

inline std::vector<std::string> cellsOf(const std::string& line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"') {
            quoted = !quoted;
        } else if (c == ',' && !quoted) {
            cells.emplace_back();
        } else if (c != '\r') {
            cells.back() += c;
        }
    }
    return cells;
}

inline std::vector<Row> rowsOf(const std::string& kind) {
    std::ifstream file{VOLCAST_SOURCE_DIR "/tests/support/numerics/hard_cases.csv"};
    std::vector<Row> rows;
    for (std::string line; std::getline(file, line);) {
        Row row = cellsOf(line);
        if (row[0].starts_with(kind)) rows.push_back(std::move(row));
    }
    return rows;
}

/// The number after `key` in `text`; NaN where there is none.
inline double after(const std::string& text, const std::string& key) {
    const std::size_t at = text.find(key);
    return at == std::string::npos ? NAN : std::strtod(text.c_str() + at + key.size(), nullptr);
}

/// What `text` lets a number be off: "rel 4e-6 + abs 1e-36", "abs 1e-36", "exact 0".
inline double allowed(const std::string& text, double right) {
    const double relative = after(text, "rel ");
    const double absolute = after(text, "abs ");
    return (std::isnan(relative) ? 0.0 : relative * std::abs(right)) +
           (std::isnan(absolute) ? 0.0 : absolute);
}

}  // namespace volcast::support
