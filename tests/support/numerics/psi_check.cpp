// psi_check: the shader's weights of ray segments against a file of right ones.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/numerics/psi_file.h"
#include "tests/support/numerics/psi_samples.h"
#include "tests/support/numerics/weight_errors.h"
#include "tests/support/numerics/weights_probe.h"

namespace {

using namespace volcast;

constexpr std::array<std::string_view, 5> kMethods{"psi", "psi_table", "linear_opacity", "average",
                                                   "psi_short"};
constexpr int kMostSamples = 1000000;
constexpr const char* kHelp = R"(psi_check [--method METHOD] FILE.csv
psi_check [--method METHOD] --random COUNT

Runs shaders/lib/psi.glsl on the GL device (Mesa's llvmpipe where there is no GPU) over a file with
the columns tau_f_D, tau_b_D, zeta, w_front, w_back, and prints the worst errors with their inputs.
The depths are rounded to float32.

  --method METHOD  psi (default), psi_table, linear_opacity, average, or psi_short, which takes only
                   rows with both depths at most 0.5
  --random COUNT   instead of a file: COUNT pairs of depths each from T, U and W below, and COUNT
                   from the edges of these squares; what is right from renderer/reference
  --help           this text

A row is past tolerance if a weight is off by more than 4e-6 of itself plus 1e-36, is below 0 or not
finite, if w_back > 2/3 alpha, or if w_front + w_back is not alpha, and 1 - zeta, within 2^-23.
Exit: 0 all rows within tolerance, 1 some are past it, 2 bad usage or file, 3 no device.
)";

int print(const support::WeightErrors& errors, std::string_view method) {
    std::printf("%.*s: %zu rows\n", static_cast<int>(method.size()), method.data(), errors.rows());
    for (const support::Worst& worst : errors.measures()) {
        if (worst.error < 0.0) {
            std::printf("%-44s no rows\n", worst.name);
            continue;
        }
        std::printf("%-44s %9.3g", worst.name, worst.error);
        if (worst.error > 0.0) {
            std::printf("  at %.9g, %.9g (line %d): %.9g, %.9g instead of %.17g, %.17g",
                        static_cast<double>(worst.row.a), static_cast<double>(worst.row.b),
                        worst.row.line, static_cast<double>(worst.weights.x),
                        static_cast<double>(worst.weights.y), worst.row.front, worst.row.back);
        }
        if (worst.past > 0) std::printf("  PAST %g in %zu rows", worst.limit, worst.past);
        std::printf("\n");
    }
    std::printf("%zu of %zu rows past tolerance\n", errors.rowsPast(), errors.rows());
    return errors.rowsPast() == 0 ? 0 : 1;
}

int fail(int code, const std::string& message) {
    std::fprintf(stderr, "psi_check: %s\n", message.c_str());
    return code;
}

int check(std::string_view method, std::vector<support::PsiRow> rows) {
    if (method == "psi_short") {
        std::erase_if(rows, [](const auto& row) { return std::max(row.a, row.b) > 0.5F; });
        if (rows.empty()) return fail(2, "psi_short: no row with both depths at most 0.5");
    }
    auto device = gpu::Device::create();
    if (!device) return fail(3, device.error().message);
    const auto probe =
        support::WeightsProbe::create(**device, "weights_" + std::string{method} + ".glsl");
    if (!probe) return fail(3, probe.error().message);
    std::vector<glm::vec2> pairs;
    pairs.reserve(rows.size());
    for (const auto& row : rows) pairs.emplace_back(row.a, row.b);
    const auto weights = (*probe)(pairs);
    if (!weights) return fail(3, weights.error().message);
    support::WeightErrors errors;
    for (std::size_t i = 0; i < rows.size(); ++i) errors.add(rows[i], (*weights)[i]);
    return print(errors, method);
}

}  // namespace

int main(int count, char** arguments) {
    std::string method = "psi";
    std::string file;
    int random = 0;
    for (int i = 1; i < count; ++i) {
        const std::string_view argument = arguments[i];
        if (argument == "--help") {
            std::fputs(kHelp, stdout);
            return 0;
        }
        if (argument == "--method" && i + 1 < count) {
            method = arguments[++i];
        } else if (argument == "--random" && i + 1 < count) {
            random = std::atoi(arguments[++i]);
            if (random < 1 || random > kMostSamples) {
                return fail(2, "--random needs a number from 1 to " + std::to_string(kMostSamples));
            }
        } else if (argument.starts_with("--") || !file.empty()) {
            return fail(2, "unexpected argument \"" + std::string{argument} + "\"; see --help");
        } else {
            file = argument;
        }
    }
    if (file.empty() == (random == 0)) {
        return fail(2, "needs FILE.csv or --random COUNT; see --help");
    }
    if (std::find(kMethods.begin(), kMethods.end(), method) == kMethods.end()) {
        return fail(2, "unknown method \"" + method +
                           "\"; allowed: psi, psi_table, linear_opacity, average, psi_short");
    }
    if (random > 0) return check(method, support::samplePsi(random, 1));
    auto rows = support::readPsiFile(file);
    if (!rows) return fail(2, rows.error().message);
    return check(method, std::move(*rows));
}
