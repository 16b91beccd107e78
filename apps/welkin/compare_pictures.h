#pragma once
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include <welkin/image/byte_image.h>
#include <welkin/image/compare.h>
#include <welkin/image/loaded_image.h>
#include <welkin/image/perceptual_difference.h>
#include <welkin/image/z_test.h>

// What `welkin compare` says of two flat pictures beyond RMSE: errors against their own standard errors, and how the
// difference looks.

namespace welkin {

/// The z-test of two files, of which one or both are OpenEXR with a layer "stderr" (R, G, B), as `welkin render` writes
/// them. Throws Error where neither is.
ZTest z_test_of_files(const std::string& a, const std::string& b, const LoadedImage& image_a,
                      const LoadedImage& image_b);
nlohmann::ordered_json z_test_json(const ZTest& test);
void print_z_test(const ZTest& test);

/// Both pictures as a display shows them: radiance is exposed by the second one's log-average and gets the filmic curve;
/// PNG and JPEG stay as they are.
struct ShownPictures {
  ByteImage a, b;
};
ShownPictures show_pictures(const LoadedImage& a, const LoadedImage& b);
PerceptualDifference perceptual_difference(const ShownPictures& pictures, double pixels_per_degree);
nlohmann::ordered_json perceptual_json(const PerceptualDifference& difference, double pixels_per_degree);

/// A page that is complete in itself: both pictures, the size of their difference, the perceptual map, the figures.
struct CompareReport {
  std::string a, b;  ///< names as they are shown
  ShownPictures shown;
  ByteImage difference;
  ImageDifference figures;
  PerceptualDifference perceptual;
  double pixels_per_degree = 0;
  std::optional<ZTest> z;
};
std::string compare_report_html(const CompareReport& report);

}  // namespace welkin
