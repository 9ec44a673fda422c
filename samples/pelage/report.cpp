// SPDX-License-Identifier: MIT
#include "report.hpp"

#include "table.hpp"

namespace pelage::app {

std::string reportText(const hair::FrameReport& report) {
    Table passes({"pass", "GPU ms", "CPU ms", "draws", "vertices", "fragments"});
    for (const passes::PassReport& pass : report.passes) {
        passes.add({pass.name, fixed(pass.gpuMilliseconds, 3), fixed(pass.cpuMilliseconds, 3),
                    std::to_string(pass.draws), std::to_string(pass.vertices), std::to_string(pass.fragments)});
    }
    passes.add({"frame", fixed(report.gpuMilliseconds, 3)});
    Table attachments({"attachment", "format", "size", "samples", "bytes"});
    std::uint64_t total = 0;
    for (const hair::AttachmentReport& attachment : report.attachments) {
        std::string size = std::to_string(attachment.extent.width) + "x" + std::to_string(attachment.extent.height);
        if (attachment.extent.depthOrArrayLayers > 1) {
            size += "x" + std::to_string(attachment.extent.depthOrArrayLayers);
        }
        attachments.add({attachment.name, attachment.format, size, std::to_string(attachment.samples),
                         std::to_string(attachment.bytes)});
        total += attachment.bytes;
    }
    attachments.add({"all", "", "", "", std::to_string(total)});
    std::string text = passes.text() + "\n" + attachments.text() + "\n";
    text += std::to_string(report.draws) + " draws, " + std::to_string(report.barriers) + " barriers, " +
            std::to_string(report.triangles) + " triangles, " + std::to_string(report.segments) + " segments, " +
            std::to_string(report.pipelinesMade) + " pipelines of materials made, " +
            std::to_string(report.pipelinesPending) + " pending\n";
    for (const std::string& culled : report.culled) text += "culled " + culled + "\n";
    return text;
}

}  // namespace pelage::app
