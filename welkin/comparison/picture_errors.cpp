#include <welkin/comparison/picture_errors.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <welkin/error.h>
#include <welkin/image/perceptual_difference.h>
#include <welkin/image/srgb.h>
#include <welkin/image/tonemap.h>

namespace welkin {
namespace {

// What a display shows of a picture, linear; pixels that are not compared are black, the same in both.
Image shown(const Image& picture, const Image& compared, double exposure_ev) {
  Image rgb(picture.width, picture.height, 3);
  for (std::size_t i = 0; i < compared.pixels.size(); ++i)
    if (compared.pixels[i] == 1)
      std::copy_n(&picture.pixels[static_cast<std::size_t>(picture.channels) * i], 3, &rgb.pixels[3 * i]);
  ToneMapOptions options;
  options.exposure_ev = exposure_ev;
  options.curve = ToneCurve::filmic;
  const ByteImage bytes = tone_map(rgb, options);
  for (std::size_t i = 0; i < rgb.pixels.size(); ++i)
    rgb.pixels[i] = static_cast<float>(srgb_to_linear(bytes.pixels[i] / 255.0));
  return rgb;
}

double mean_flip(const Image& picture, const Image& truth, const Image& compared) {
  const double exposure = automatic_exposure_ev(truth);
  const PerceptualDifference difference =
      perceptual_difference(shown(picture, compared, exposure), shown(truth, compared, exposure));
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < compared.pixels.size(); ++i) {
    if (compared.pixels[i] != 1) continue;
    sum += double{difference.map.pixels[i]};
    count += 1;
  }
  return sum / count;
}

struct Sums {
  double truth = 0, truth_square = 0, difference = 0, absolute = 0, square = 0, error = 0, edges = 0;
  std::vector<float> absolutes;
};

void add_pixel(Sums& sums, const float* picture, const float* truth, const float* error) {
  for (int c = 0; c < 3; ++c) {
    const double t = double{truth[c]}, d = double{picture[c]} - t;
    sums.truth += t;
    sums.truth_square += t * t;
    sums.difference += d;
    sums.absolute += std::abs(d);
    sums.square += d * d;
    sums.error += double{error[c]};
    sums.absolutes.push_back(static_cast<float>(std::abs(d)));
  }
}

PictureErrors finish(Sums& sums, PictureErrors e) {
  const double values = 3 * static_cast<double>(e.pixels);
  const auto by_mean = [&](double value) { return e.truth_mean > 0 ? value / e.truth_mean : 0; };
  e.truth_mean = sums.truth / values;
  e.mean_absolute = by_mean(sums.absolute / values);
  e.bias = by_mean(sums.difference / values);
  e.rms = sums.truth_square > 0 ? std::sqrt(sums.square / sums.truth_square) : 0;
  // The mean size of a normal variable is sqrt(2 / pi) times its deviation.
  e.truth_noise = by_mean(sums.error / values * std::sqrt(2 / std::numbers::pi));
  const auto place = static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(sums.absolutes.size() - 1));
  std::nth_element(sums.absolutes.begin(), sums.absolutes.begin() + place, sums.absolutes.end());
  e.p99 = by_mean(double{sums.absolutes[static_cast<std::size_t>(place)]});
  e.largest = by_mean(double{*std::max_element(sums.absolutes.begin() + place, sums.absolutes.end())});
  if (e.edge_pixels > 0)
    e.edge_mean_absolute = by_mean(sums.edges / (3 * static_cast<double>(e.edge_pixels)));
  return e;
}

}  // namespace

Image compared_pixels(const Image& picture, const TruthPicture& truth) {
  if (picture.width != truth.radiance.width || picture.height != truth.radiance.height)
    throw Error("the picture and its truth are of different sizes");
  Image compared(picture.width, picture.height, 1);
  for (std::size_t i = 0; i < compared.pixels.size(); ++i) {
    const float own = picture.pixels[4 * i + 3], other = truth.coverage.pixels[i];
    const bool full = own > 0.9999f && other > 0.9999f, empty = own <= 0 && other <= 0;
    compared.pixels[i] = full ? 1.0f : empty ? 0.0f : 0.5f;
  }
  return compared;
}

Image mean_of_blocks(const Image& image, int factor) {
  Image mean(image.width / factor, image.height / factor, image.channels);
  const float share = 1 / static_cast<float>(factor * factor);
  for (int y = 0; y < mean.height * factor; ++y)
    for (int x = 0; x < mean.width * factor; ++x)
      for (int c = 0; c < image.channels; ++c)
        mean.at(x / factor, y / factor)[c] += share * image.at(x, y)[c];
  return mean;
}

PictureErrors compare_with_truth(const Image& picture, const TruthPicture& truth) {
  const Image compared = compared_pixels(picture, truth);
  PictureErrors errors;
  Sums sums;
  for (std::size_t i = 0; i < compared.pixels.size(); ++i) {
    const float *own = &picture.pixels[4 * i], *other = &truth.radiance.pixels[3 * i];
    if (compared.pixels[i] == 1) {
      ++errors.pixels;
      add_pixel(sums, own, other, &truth.standard_error.pixels[3 * i]);
    } else if (compared.pixels[i] > 0) {
      ++errors.edge_pixels;
      for (int c = 0; c < 3; ++c) sums.edges += std::abs(double{own[c]} - double{other[c]});
    }
  }
  if (errors.pixels == 0) throw Error("no pixel is covered in full by surfaces: there is nothing to compare");
  errors = finish(sums, errors);
  errors.flip = mean_flip(picture, truth.radiance, compared);
  return errors;
}

}  // namespace welkin
