// SPDX-License-Identifier: MIT
// `pelage scatter`: scattering of single rays about one fibre, so that any renderer can be held against the truth and
// against every model here, in the arithmetic of its choice.
#include "commands.hpp"
#include "scatter_models.hpp"
#include "scatter_plot.hpp"
#include "text_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pelage::app {

namespace {

constexpr int exitSomeRowsBad = 1;

Diagnostic contradiction(const std::string& what) {
    return failure("A095", what + "; see pelage scatter --help");
}

Result<const hair::ModelInfo*> findModel(const std::string& id) {
    if (const hair::ModelInfo* info = hair::findScatteringModel(id)) return info;
    std::string known;
    for (const hair::ModelInfo& info : hair::scatteringModels()) {
        known += (known.empty() ? "" : ", ") + std::string(info.id);
    }
    return tl::unexpected(failure("A097", "there is no scattering model \"" + id + "\"; known: " + known));
}

Result<ScatterMethod> methodOf(const ScatterOptions& options) {
    if (options.exact == !options.model.empty()) {
        return tl::unexpected(contradiction("expected --exact or --model ID, and not both"));
    }
    if (options.exact) {
        if (options.published || options.precision != "double") {
            return tl::unexpected(
                contradiction("--exact has one form, in double: --published and --precision are "
                              "of models"));
        }
        return ScatterMethod{};
    }
    const auto model = findModel(options.model);
    if (!model) return tl::unexpected(model.error());
    if (options.published && !(*model)->corrected) {
        warn(Diagnostic{.severity = Severity::Warning,
                        .code = "A098",
                        .text = "--published changes nothing: no error is known in the source of " + options.model});
    }
    return ScatterMethod{*model, options.published, options.precision == "float"};
}

Result<std::vector<std::optional<RowLobes>>> onDevice(const ScatterOptions& options, const ScatterMethod& method,
                                                      std::span<const ScatterRow> rows) {
    std::vector<ScatterQuery> queries;
    for (const ScatterRow& row : rows) {
        if (row.usable) queries.push_back(scatterQuery(row.tuple));
    }
    const auto results = scatterOnDevice(options.device, method.model->model, method.published, queries);
    if (!results) return tl::unexpected(results.error());
    std::vector<std::optional<RowLobes>> lobes(rows.size());
    std::size_t next = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!rows[i].usable) continue;
        const auto& s = (*results)[next++].lobe;
        lobes[i] = RowLobes{s[0][0], s[1][0], s[2][0], s[3][0]};
    }
    return lobes;
}

/// No model should give one, but a driver may: an infinity in a table is found late, a named row at once.
void refuseWhatIsNotFinite(std::span<const ScatterRow> rows, std::vector<std::optional<RowLobes>>& lobes,
                           std::vector<RowFault>& faults) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!lobes[i] || std::isfinite((*lobes[i])[0] + (*lobes[i])[1] + (*lobes[i])[2] + (*lobes[i])[3])) continue;
        lobes[i].reset();
        faults.push_back(
            {rows[i].line, "the result is not finite; expected a number, so this is a fault of the model"});
    }
    std::stable_sort(faults.begin(), faults.end(), [](const auto& a, const auto& b) { return a.line < b.line; });
}

int writeRows(const ScatterOptions& options) {
    const auto method = methodOf(options);
    if (!method) return report(method.error());
    const auto text = readTextFile(options.input);
    if (!text) return report(text.error());
    const std::string name = options.input == "-" ? "stdin" : options.input;
    auto read = readScatterRows(*text, name);
    if (!read) return report(read.error());
    std::vector<std::optional<RowLobes>> lobes;
    if (options.precision == "gpu") {
        auto results = onDevice(options, *method, read->rows);
        if (!results) return report(results.error());
        lobes = std::move(*results);
    } else {
        lobes = evaluateRows(*method, read->rows);
    }
    refuseWhatIsNotFinite(read->rows, lobes, read->faults);
    const auto written =
        writeTextFile(options.output, writeScatterRows(read->rows, lobes, options.precision == "double" ? 17 : 9));
    if (!written) return report(written.error());
    for (const RowFault& fault : read->faults) {
        std::fprintf(stderr, "%s:%zu: %s\n", name.c_str(), fault.line, fault.text.c_str());
    }
    return read->faults.empty() ? exitOk : exitSomeRowsBad;
}

Result<ScatterPlot> plotOf(const ScatterOptions& options) {
    ScatterPlot plot{.published = options.published};
    plot.fiber = {.thetaO = options.thetaO,
                  .eta = options.eta,
                  .betaM = options.betaM,
                  .betaN = options.betaN,
                  .alpha = options.alpha,
                  .sigmaA = options.sigmaA};
    std::string left = options.model.empty() ? options.models : options.model;
    while (!left.empty()) {
        const std::size_t comma = left.find(',');
        const auto model = findModel(left.substr(0, comma));
        if (!model) return tl::unexpected(model.error());
        plot.models.push_back(*model);
        left.erase(0, comma == std::string::npos ? comma : comma + 1);
    }
    return plot;
}

int writePlot(const ScatterOptions& options) {
    if (options.exact) return report(contradiction("--plot draws the truth anyway: leave --exact out"));
    for (const double x : {options.thetaO, options.eta, options.betaM, options.betaN, options.alpha, options.sigmaA}) {
        if (!std::isfinite(x)) return report(contradiction("the fibre of --plot needs numbers, found nan or inf"));
    }
    if (options.input != "-" || options.output != "-") {
        return report(contradiction("--plot draws one fibre, given by --eta and others: no INPUT and no -o"));
    }
    if (const auto possible = checkDrawingPath(options.plot); !possible) return report(possible.error());
    const auto plot = plotOf(options);
    if (!plot) return report(plot.error());
    const auto written = writeDrawing(options.plot, drawScatterPlot(*plot));
    return written ? exitOk : report(written.error());
}

}  // namespace

int scatter(const ScatterOptions& options) {
    return options.plot.empty() ? writeRows(options) : writePlot(options);
}

}  // namespace pelage::app
