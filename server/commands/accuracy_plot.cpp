#include "server/commands/accuracy_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

namespace volcast::commands {

namespace {

// Pixels of the drawing.
constexpr int kColumns = 3;
constexpr double kPanelWidth = 330.0, kPanelHeight = 240.0;
constexpr double kLeft = 64.0, kRight = 14.0, kTop = 30.0, kBottom = 44.0;  // Within a panel.
constexpr double kTitle = 56.0, kLegend = 62.0;

struct Colour {
    const char* integrator;
    const char* rgb;
};
/// M. Okabe, K. Ito, Color Universal Design, 2008; the yellow darkened for white paper.
constexpr std::array kColours{
    Colour{"average", "#E69F00"},       Colour{"linear_opacity", "#56B4E9"},
    Colour{"psi_table", "#B8A800"},     Colour{"psi", "#0072B2"},
    Colour{"preintegrated", "#CC79A7"}, Colour{"exact", "#000000"},
    Colour{"front", "#D55E00"},         Colour{"ends", "#009E73"},
    Colour{"adaptive", "#8B1A1A"}};

struct Shape {
    const char* evaluator;
    const char* path;  ///< Around (0, 0).
};
constexpr std::array kShapes{
    Shape{"walk", "M-5,0a5,5 0 1,0 10,0a5,5 0 1,0 -10,0Z"},
    Shape{"projection", "M-4.5,-4.5h9v9h-9Z"},
    Shape{"projection_faces", "M0,-6L5.5,4.5H-5.5Z"},
    Shape{"auto", "M0,-6.5L6.5,0L0,6.5L-6.5,0Z"},
};

std::string number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2f", value);
    return text.data();
}

std::string general(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g", value);
    return text.data();
}

/// 10 to the power of `exponent`, as it is written.
std::string powerOfTen(int exponent) {
    constexpr std::array kRaised{"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                 "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    std::string text = exponent < 0 ? "10\u207b" : "10";
    for (const char digit : std::to_string(std::abs(exponent))) text += kRaised.at(digit - '0');
    return text;
}

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&': out += "&amp;"; break;
            case '<': out += "&lt;"; break;
            case '>': out += "&gt;"; break;
            case '"': out += "&quot;"; break;
            default: out += (static_cast<unsigned char>(c) < 0x20 ? ' ' : c);
        }
    }
    return out;
}

std::string label(double x, double y, const std::string& anchor, const std::string& text,
                  const std::string& more = {}) {
    return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\"" +
           more + ">" + escaped(text) + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, const char* style) {
    return "<path d=\"M" + number(x1) + "," + number(y1) + "L" + number(x2) + "," + number(y2) +
           "\" class=\"" + style + "\"/>\n";
}

std::string mark(double x, double y, const std::string& evaluator, const std::string& integrator,
                 bool filled) {
    const auto shape = std::ranges::find(kShapes, evaluator, &Shape::evaluator);
    const auto colour = std::ranges::find(kColours, integrator, &Colour::integrator);
    const std::string rgb = colour == kColours.end() ? "#444444" : colour->rgb;
    return "<path transform=\"translate(" + number(x) + "," + number(y) + ")\" d=\"" +
           (shape == kShapes.end() ? kShapes.back().path : shape->path) + "\" stroke=\"" + rgb +
           R"(" stroke-width="1.6" fill=")" + (filled ? rgb : "#ffffff") + "\"/>\n";
}

/// A logarithmic axis from `low` to `high`, drawn from `begin` to `end`.
struct Axis {
    double low, high, begin, end;
    [[nodiscard]] double at(double value) const {
        const double part = (std::log10(std::clamp(value, low, high)) - std::log10(low)) /
                            (std::log10(high) - std::log10(low));
        return begin + part * (end - begin);
    }
};

struct Extent {
    double least = 0.0, most = 0.0;  ///< Of values above 0; 0: none.
    void include(double value) {
        if (!(value > 0.0) || !std::isfinite(value)) return;
        least = least == 0.0 ? value : std::min(least, value);
        most = std::max(most, value);
    }
};

struct Panel {
    std::string title;
    std::vector<const AccuracyRow*> rows;
};

std::vector<Panel> panelsOf(const AccuracyRun& run) {
    const bool severalLayers = std::ranges::any_of(run.rows, [&run](const AccuracyRow& row) {
        return row.measured && row.layer != run.rows.front().layer;
    });
    std::vector<Panel> panels;
    for (const AccuracyRow& row : run.rows) {
        if (!row.measured) continue;
        const std::string title = row.model + (severalLayers ? " (" + row.layer + ")" : "") +
                                  (row.sampling.empty() ? "" : ", " + row.sampling);
        if (panels.empty() || panels.back().title != title) panels.push_back({title, {}});
        panels.back().rows.push_back(&row);
    }
    return panels;
}

/// 1, 2 and 5 times each power of ten.
std::vector<double> finerTicks(double low, double high) {
    std::vector<double> ticks;
    for (double power = std::pow(10.0, std::floor(std::log10(low))); power <= high; power *= 10.0) {
        for (const double factor : {1.0, 2.0, 5.0}) {
            if (power * factor >= 0.999 * low && power * factor <= 1.001 * high) {
                ticks.push_back(power * factor);
            }
        }
    }
    return ticks;
}

class Plot {
public:
    explicit Plot(const AccuracyRun& run) : run_{run}, panels_{panelsOf(run)} {
        Extent times;
        Extent errors;
        for (const Panel& panel : panels_) {
            for (const AccuracyRow* row : panel.rows) {
                times.include(row->measured->medianMs);
                errors.include(errorOf(*row));
            }
        }
        if (times.least == 0.0) times = {1.0, 10.0};
        if (errors.least == 0.0) errors = {1e-7, 1e-1};
        lowMs_ = times.least / 1.3;
        highMs_ = std::max(times.most * 1.3, lowMs_ * 5.0);
        lowError_ = std::pow(10.0, std::floor(std::log10(errors.least) - 0.2));
        highError_ =
            std::max(std::pow(10.0, std::ceil(std::log10(errors.most) + 0.1)), lowError_ * 100.0);
    }

    std::string svg() {
        const auto count = static_cast<int>(panels_.size());
        const int columns = std::clamp(count, 1, kColumns);
        const int rows = std::max(1, (count + columns - 1) / columns);
        // Legends need two panels' width.
        const double width = std::max(2, columns) * kPanelWidth;
        const double height = kTitle + rows * kPanelHeight + kLegend;
        out_ = R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 )" + number(width) + " " +
               number(height) + "\" width=\"" + number(width) + "\" height=\"" + number(height) +
               "\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#111111\">\n"
               "<style>.frame{fill:none;stroke:#333333}.grid{fill:none;stroke:#e2e2e2}"
               ".front{fill:none;stroke:#888888;stroke-width:1.5;stroke-dasharray:4 3}</style>\n"
               "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
        title();
        for (int i = 0; i < count; ++i) {
            const int row = i / columns, column = i % columns;
            panel(panels_[i], column * kPanelWidth, kTitle + row * kPanelHeight);
        }
        legend(kTitle + rows * kPanelHeight + 18.0);
        return std::move(out_) + "</svg>\n";
    }

private:
    void title() {
        out_ += label(16.0, 22.0, "start", "What accuracy costs: " + run_.data,
                      R"( font-size="16" font-weight="bold")");
        out_ += label(16.0, 42.0, "start",
                      std::to_string(run_.cells) + " " + run_.unit + ", " +
                          std::to_string(run_.size.x) + " x " + std::to_string(run_.size.y) +
                          " pixels, " + run_.gl);
    }

    void panel(const Panel& panel, double x, double y) {
        const Axis time{lowMs_, highMs_, x + kLeft, x + kPanelWidth - kRight};
        const Axis error{lowError_, highError_, y + kPanelHeight - kBottom, y + kTop};
        out_ += label((time.begin + time.end) / 2, y + kTop - 10.0, "middle", panel.title,
                      " font-weight=\"bold\"");
        axes(time, error, x);
        front(panel, time, error);
        for (const AccuracyRow* row : panel.rows) {
            out_ += "<g><title>" +
                    escaped(row->integrator + ", " +
                            (row->step > 0.0 ? "step " + general(row->step) : row->evaluator) +
                            ": " + general(row->measured->medianMs) + " ms, rms error " +
                            general(errorOf(*row))) +
                    "</title>" +
                    mark(time.at(row->measured->medianMs), error.at(errorOf(*row)), row->evaluator,
                         row->integrator, row->onFront) +
                    "</g>\n";
        }
    }

    void axes(const Axis& time, const Axis& error, double x) {
        std::vector<double> ticks = finerTicks(lowMs_, highMs_);
        if (ticks.size() > 7) {  // Powers of ten alone.
            std::erase_if(ticks, [](double tick) {
                return std::abs(std::remainder(std::log10(tick), 1.0)) > 1e-6;
            });
        }
        for (const double tick : ticks) {
            out_ += line(time.at(tick), error.begin, time.at(tick), error.end, "grid");
            out_ += label(time.at(tick), error.begin + 15.0, "middle", general(tick));
        }
        const double decades = std::round(std::log10(highError_ / lowError_));
        const int stride = decades > 7.0 ? 2 : 1;
        for (int i = 0; i <= static_cast<int>(decades); i += stride) {
            const double tick = lowError_ * std::pow(10.0, i);
            out_ += line(time.begin, error.at(tick), time.end, error.at(tick), "grid");
            out_ += label(time.begin - 6.0, error.at(tick) + 4.0, "end",
                          powerOfTen(static_cast<int>(std::lround(std::log10(tick)))));
        }
        out_ += "<rect x=\"" + number(time.begin) + "\" y=\"" + number(error.end) + "\" width=\"" +
                number(time.end - time.begin) + "\" height=\"" + number(error.begin - error.end) +
                "\" class=\"frame\"/>\n";
        out_ += label((time.begin + time.end) / 2, error.begin + 32.0, "middle",
                      "median time of a frame [ms]");
        const double middle = (error.begin + error.end) / 2;
        out_ += label(x + 14.0, middle, "middle", "RMS error, linear light",
                      " transform=\"rotate(-90 " + number(x + 14.0) + " " + number(middle) + ")\"");
    }

    void front(const Panel& panel, const Axis& time, const Axis& error) {
        std::vector<std::pair<double, double>> points;
        for (const AccuracyRow* row : panel.rows) {
            if (row->onFront) {
                points.emplace_back(time.at(row->measured->medianMs), error.at(errorOf(*row)));
            }
        }
        if (points.size() < 2) return;
        std::ranges::sort(points);
        std::string path;
        for (const auto& [x, y] : points) {
            path += (path.empty() ? "M" : "L") + number(x) + "," + number(y);
        }
        out_ += "<path d=\"" + path + "\" class=\"front\"/>\n";
    }

    /// Colours and shapes that occur.
    void legend(double y) {
        const auto occurs = [this](auto member, const std::string& name) {
            return std::ranges::any_of(run_.rows, [&](const AccuracyRow& row) {
                return row.measured.has_value() && row.*member == name;
            });
        };
        double x = 24.0;
        for (const Colour& colour : kColours) {
            if (!occurs(&AccuracyRow::integrator, colour.integrator)) continue;
            out_ += mark(x, y - 4.0, "walk", colour.integrator, true);
            out_ += label(x + 10.0, y, "start", colour.integrator);
            x += 30.0 + 7.0 * static_cast<double>(std::string_view{colour.integrator}.size());
        }
        x = 24.0;
        y += 24.0;
        for (const Shape& shape : kShapes) {
            if (!occurs(&AccuracyRow::evaluator, shape.evaluator)) continue;
            const std::string name = shape.evaluator;
            out_ += mark(x, y - 4.0, name, "", false);
            out_ += label(x + 10.0, y, "start", name == "auto" ? "triangles, voxels" : name);
            x += 44.0 + 7.0 * static_cast<double>(std::max<std::size_t>(name.size(), 8));
        }
        out_ += line(x, y - 4.0, x + 24.0, y - 4.0, "front");
        out_ += label(x + 30.0, y, "start", "filled: nothing is both faster and more accurate");
    }

    const AccuracyRun& run_;
    std::vector<Panel> panels_;
    double lowMs_ = 0.0, highMs_ = 0.0, lowError_ = 0.0, highError_ = 0.0;
    std::string out_;
};

}  // namespace

std::string plotOf(const AccuracyRun& run) {
    return Plot{run}.svg();
}

}  // namespace volcast::commands
