// SPDX-License-Identifier: MIT
#include "scatter_device.hpp"

#include "gpu.hpp"

#include <pelage/hair/scatter_compute.hpp>

namespace pelage::app {

Result<std::vector<hair::ScatteredLobes>> scatterOnDevice(const DeviceOptions& options, hair::ScatteringModel model,
                                                          bool published, std::span<const ScatterQuery> queries) {
    auto gpu = openGpu(options);
    if (!gpu) return tl::unexpected(gpu.error());
    std::vector<hair::ScatterRow> rows;
    rows.reserve(queries.size());
    for (const ScatterQuery& query : queries) rows.push_back({query.fiber, query.directions});
    auto results = hair::ScatterCompute(gpu->device).evaluate(model, published, rows);
    if (!results) return tl::unexpected(results.error());
    if (finish(*gpu) != exitOk)
        return tl::unexpected(failure("A031", "the validation layer reported errors, listed above"));
    return std::move(*results);
}

}  // namespace pelage::app
