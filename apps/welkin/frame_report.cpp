#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "frame_reference.h"
#include "json_text.h"

namespace welkin {

void print_report(const FrameReport& report) {
  fmt::print("{}: {} x {}, {}\n", report.output, report.size.width, report.size.height, report.technique);
  if (report.errors) {
    const PictureErrors& e = *report.errors;
    fmt::print("against {}, {} pixels that surfaces cover in full, relative to the truth's mean of {:.4g}:\n",
               report.truth, e.pixels, e.truth_mean);
    fmt::print("  mean absolute error  {:8.4f} %   of which {:.4f} % could be the truth's noise\n",
               100 * e.mean_absolute, 100 * e.truth_noise);
    fmt::print("  mean error           {:+8.4f} %\n", 100 * e.bias);
    fmt::print("  RMS over RMS         {:8.4f} %\n", 100 * e.rms);
    fmt::print("  99th percentile      {:8.4f} %\n", 100 * e.p99);
    fmt::print("  largest              {:8.4f} %\n", 100 * e.largest);
    fmt::print("  FLIP-like            {:8.4f}\n", e.flip);
    fmt::print("  at {} edge pixels  {:.4f} %\n", e.edge_pixels, 100 * e.edge_mean_absolute);
  }
  if (!report.times.empty()) fmt::print("median times in milliseconds:\n");
  for (const FrameTime& time : report.times)
    fmt::print("  {:{}}{:<{}} {:9.3f}\n", "", 2 * time.depth, time.pass, 32 - 2 * time.depth,
               time.milliseconds);
}

std::string report_json(const FrameReport& report) {
  nlohmann::ordered_json json{{"output", report.output},    {"technique", report.technique},
                              {"truth", report.truth},      {"scene", report.scene},
                              {"width", report.size.width}, {"height", report.size.height}};
  if (report.errors) {
    const PictureErrors& e = *report.errors;
    json["errors"] = {{"pixels", e.pixels},
                      {"truth_mean", e.truth_mean},
                      {"mean_absolute", e.mean_absolute},
                      {"mean", e.bias},
                      {"rms", e.rms},
                      {"p99", e.p99},
                      {"largest", e.largest},
                      {"flip", e.flip},
                      {"truth_noise", e.truth_noise},
                      {"edge_pixels", e.edge_pixels},
                      {"edge_mean_absolute", e.edge_mean_absolute}};
  }
  for (const FrameTime& time : report.times)
    json["milliseconds"].push_back(
        {{"pass", time.pass}, {"depth", time.depth}, {"median", time.milliseconds}});
  return json_text(json);
}

}  // namespace welkin
