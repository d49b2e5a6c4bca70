// SPDX-License-Identifier: GPL-3.0-or-later
// Thin strips that together hold all error of a claim, and what follows of its area and width
// (docs: oracle, "Success by borders"): the area is at most the sum of theirs, and no disc in their
// union is wider than the sum of their widths.
//
// Exactness: upper bounds; sums of less than 2^20 terms are off by less than what is added to them.
#ifndef GNOMON_ORACLE_JUDGE_ERROR_STRIPS_H
#define GNOMON_ORACLE_JUDGE_ERROR_STRIPS_H

namespace gnomon::oracle {

class ErrorStrips {
 public:
  /// `radius`: of rounding, scene units; 0 if nothing is excused.
  explicit ErrorStrips(long double radius) : radius_(radius) {}

  /// Scene units. `reach`: all that errs in the strip is within it of a claimed or true border.
  void add(long double width, long double length, long double reach) {
    area_ += width * length;
    width_ += width;
    excused_ = excused_ && reach <= radius_;
  }
  void add(const ErrorStrips& other) {
    area_ += other.area_;
    width_ += other.width_;
    excused_ = excused_ && other.excused_;
  }

  bool empty() const { return width_ == 0; }
  long double area() const { return kRoundedUp * area_; }
  long double width() const { return kRoundedUp * width_; }
  /// All that errs is rounding.
  bool excused() const { return excused_; }
  bool within(long double area, long double width) const {
    return excused_ || (this->area() <= area && this->width() <= width);
  }

 private:
  static constexpr long double kRoundedUp = 1 + 0x1p-40L;
  long double radius_, area_ = 0, width_ = 0;
  bool excused_ = true;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_ERROR_STRIPS_H
