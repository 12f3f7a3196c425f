// SPDX-License-Identifier: GPL-3.0-or-later
#include "utf8_input.h"

#include <cstdint>
#include <optional>
#include <utility>

namespace kinetri {
namespace {

constexpr std::size_t piece_size = std::size_t{1} << 16U;

enum class Byte_order { little, big };

// The byte order of UTF-16; none if the text is not in UTF-16.
std::optional<Byte_order> byte_order(std::string_view head) {
  using namespace std::string_view_literals;
  if (head.starts_with("\xFF\xFE"sv)) return Byte_order::little;
  if (head.starts_with("\xFE\xFF"sv)) return Byte_order::big;
  // Without a mark: two characters of ASCII.
  if (head.size() < 4) return std::nullopt;
  const auto are_zero = [head](std::size_t first) {
    return head[first] == '\0' && head[first + 2] == '\0' && head[1 - first] != '\0' &&
           head[3 - first] != '\0';
  };
  if (are_zero(0)) return Byte_order::big;
  return are_zero(1) ? std::optional(Byte_order::little) : std::nullopt;
}

void append_utf8(std::string& text, std::uint32_t code) {
  const auto add = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  const auto add_rest = [&](unsigned shift) { add(0x80U | ((code >> shift) & 0x3FU)); };
  if (code < 0x80) {
    add(code);
  } else if (code < 0x800) {
    add(0xC0U | (code >> 6U));
    add_rest(0);
  } else if (code < 0x10000) {
    add(0xE0U | (code >> 12U));
    add_rest(6);
    add_rest(0);
  } else {
    add(0xF0U | (code >> 18U));
    add_rest(12);
    add_rest(6);
    add_rest(0);
  }
}

class Utf16_buffer : public std::streambuf {
 public:
  Utf16_buffer(std::istream& in, Byte_order order) : in_(in), order_(order) {}

 protected:
  int_type underflow() override {
    text_.clear();
    while (text_.empty() && !is_at_end_) convert_piece();
    setg(text_.data(), text_.data(), text_.data() + text_.size());
    return text_.empty() ? traits_type::eof() : traits_type::to_int_type(*gptr());
  }

 private:
  void convert_piece() {
    const std::size_t kept = bytes_.size();  // half a unit
    bytes_.resize(kept + piece_size);
    in_.read(bytes_.data() + kept, static_cast<std::streamsize>(piece_size));
    // An exception makes the stream of this buffer bad as well.
    if (in_.bad()) throw std::ios_base::failure("reading failed");
    bytes_.resize(kept + static_cast<std::size_t>(in_.gcount()));
    is_at_end_ = in_.gcount() == 0;
    std::size_t at = 0;
    for (; at + 1 < bytes_.size(); at += 2) take(unit(at));
    bytes_.erase(0, at);
    if (!is_at_end_) return;
    if (high_ != 0) append_utf8(text_, std::exchange(high_, 0));
    if (!bytes_.empty()) append_utf8(text_, 0xFFFD);
    bytes_.clear();
  }

  std::uint32_t unit(std::size_t at) const {
    const std::uint32_t first = static_cast<unsigned char>(bytes_[at]);
    const std::uint32_t second = static_cast<unsigned char>(bytes_[at + 1]);
    return order_ == Byte_order::little ? first | second << 8U : second | first << 8U;
  }

  void take(std::uint32_t unit) {
    const bool is_low = unit >= 0xDC00 && unit < 0xE000;
    if (high_ != 0) {
      const std::uint32_t high = std::exchange(high_, 0);
      if (is_low) {
        append_utf8(text_, 0x10000 + ((high - 0xD800) << 10U) + (unit - 0xDC00));
        return;
      }
      append_utf8(text_, high);
    }
    if (unit >= 0xD800 && unit < 0xDC00) {
      high_ = unit;
    } else {
      append_utf8(text_, unit);  // a byte order mark is kept
    }
  }

  std::istream& in_;
  Byte_order order_;
  std::string bytes_;
  std::string text_;
  std::uint32_t high_ = 0;  // the high surrogate of a pair
  bool is_at_end_ = false;
};

}  // namespace

Replayed_buffer::Replayed_buffer(std::string head, std::istream& rest)
    : piece_(std::move(head)), rest_(rest) {
  setg(piece_.data(), piece_.data(), piece_.data() + piece_.size());
}

Replayed_buffer::int_type Replayed_buffer::underflow() {
  piece_.resize(piece_size);
  rest_.read(piece_.data(), static_cast<std::streamsize>(piece_.size()));
  // An exception makes the stream of this buffer bad as well.
  if (rest_.bad()) throw std::ios_base::failure("reading failed");
  const auto end = static_cast<std::size_t>(rest_.gcount());
  setg(piece_.data(), piece_.data(), piece_.data() + end);
  return end == 0 ? traits_type::eof() : traits_type::to_int_type(*gptr());
}

Utf8_input::Utf8_input(std::istream& in) {
  std::string head(4, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  // A failure occurs again when the stream is read.
  head.resize(static_cast<std::size_t>(in.gcount()));
  const auto order = byte_order(head);
  replayed_ = std::make_unique<Replayed_buffer>(std::move(head), in);
  whole_ = std::make_unique<std::istream>(replayed_.get());
  is_converted_ = order.has_value();
  if (order) converted_ = std::make_unique<Utf16_buffer>(*whole_, *order);
  stream_ = std::make_unique<std::istream>(order ? converted_.get() : replayed_.get());
}

}  // namespace kinetri
