// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/codec/quality.h"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace kinetri::video {
namespace {

// Does not change the samples.
cv::Mat matrix_of(const std::vector<std::uint8_t>& plane, std::size_t columns, std::size_t rows) {
  const cv::Mat bytes(static_cast<int>(rows), static_cast<int>(columns), CV_8UC1,
                      const_cast<std::uint8_t*>(plane.data()));
  cv::Mat result;
  bytes.convertTo(result, CV_64F);
  return result;
}

cv::Mat smoothed(const cv::Mat& m) {
  cv::Mat result;
  cv::GaussianBlur(m, result, cv::Size(11, 11), 1.5);
  return result;
}

}  // namespace

double Frame_quality::psnr(std::size_t plane) const {
  if (mean_square[plane] == 0) return std::numeric_limits<double>::infinity();
  return 10 * std::log10(255.0 * 255.0 / mean_square[plane]);
}

double ssim(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b,
            std::size_t columns, std::size_t rows) {
  // (0.01 * 255)^2 and (0.03 * 255)^2, as in the paper.
  constexpr double c1 = 6.5025;
  constexpr double c2 = 58.5225;
  const cv::Mat x = matrix_of(a, columns, rows);
  const cv::Mat y = matrix_of(b, columns, rows);
  const cv::Mat mean_x = smoothed(x);
  const cv::Mat mean_y = smoothed(y);
  const cv::Mat means = mean_x.mul(mean_y);
  const cv::Mat squares = mean_x.mul(mean_x) + mean_y.mul(mean_y);
  const cv::Mat covariance = smoothed(x.mul(y)) - means;
  const cv::Mat variances = smoothed(x.mul(x)) + smoothed(y.mul(y)) - squares;
  cv::Mat result;
  cv::divide((2 * means + c1).mul(2 * covariance + c2), (squares + c1).mul(variances + c2), result);
  return cv::mean(result)[0];
}

void Quality::add(const Frame& source, const Frame& other) {
  Frame_quality result;
  for (std::size_t plane = 0; plane < format_.planes(); ++plane) {
    const auto& a = source.planes[plane];
    const auto& b = other.planes[plane];
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const int difference = a[i] - b[i];
      sum += static_cast<std::uint64_t>(difference * difference);
    }
    result.mean_square[plane] = static_cast<double>(sum) / static_cast<double>(a.size());
    const std::size_t columns = plane == 0 ? format_.width : format_.chroma_width();
    result.ssim[plane] = ssim(a, b, columns, a.size() / columns);
  }
  if (!frames_.empty()) {
    for (std::size_t i = 0; i < source.planes[0].size(); ++i) {
      if (std::abs(source.planes[0][i] - last_source_.planes[0][i]) > 1) continue;
      ++resting_;
      changes_ += std::abs(other.planes[0][i] - last_other_.planes[0][i]);
    }
  }
  last_source_ = source;
  last_other_ = other;
  frames_.push_back(result);
}

Frame_quality Quality::mean() const {
  Frame_quality result;
  for (const Frame_quality& frame : frames_) {
    for (std::size_t plane = 0; plane < 3; ++plane) {
      result.mean_square[plane] += frame.mean_square[plane] / static_cast<double>(frames_.size());
      result.ssim[plane] += frame.ssim[plane] / static_cast<double>(frames_.size());
    }
  }
  return result;
}

std::optional<double> Quality::flicker() const {
  if (resting_ == 0) return std::nullopt;
  return changes_ / static_cast<double>(resting_);
}

}  // namespace kinetri::video
