// SPDX-License-Identifier: MIT
#include "generous_host.hpp"

namespace pelage::app {

passes::HostDescription generousHost(const passes::PassTree& tree, const rhi::Extent3D& extent) {
    passes::HostDescription host{.extent = extent};
    host.trustClasses = true;
    for (const passes::WantedImport& import : tree.imports()) {
        passes::LentImport lent{.present = true, .format = rhi::TextureFormat::RGBA16Float, .extent = host.extent};
        if (!import.formats.empty()) lent.format = import.formats.front();
        if (!import.samples.empty()) lent.samples = import.samples.front();
        host.imports[import.name] = lent;
    }
    return host;
}

}  // namespace pelage::app
