// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/scene/digest.h"

#include <openssl/evp.h>

#include <bit>
#include <charconv>
#include <cstdint>
#include <memory>
#include <new>
#include <span>

namespace gnomon {

namespace {

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1) {
      throw std::bad_alloc();
    }
  }
  void add(const std::string& text) { EVP_DigestUpdate(context_.get(), text.data(), text.size()); }
  std::string hex() {
    constexpr char kHex[] = "0123456789abcdef";
    unsigned char bytes[EVP_MAX_MD_SIZE];
    unsigned int size = 0;
    EVP_DigestFinal_ex(context_.get(), bytes, &size);
    std::string text;
    for (const unsigned char byte : std::span(bytes, size)) {
      text += kHex[byte >> 4];
      text += kHex[byte & 15];
    }
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

constexpr std::size_t kDigits = 24;  // room for an integer of 64 bits
template <class Integer>
char* write_integer(char* text, Integer value, int base = 10) {
  return std::to_chars(text, text + kDigits, value, base).ptr;
}

void append_canonical(std::string& text, const Number& number) {
  if (number.is_zero()) {
    text += '0';
    return;
  }
  std::int64_t twos = number.exponent();
  std::int64_t fives = number.is_decimal() ? number.exponent() : 0;
  char buffer[3 * kDigits + 2];
  char* end = buffer;
  if (number.has_small_mantissa()) {
    std::int64_t mantissa = number.small_mantissa();
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
    twos += zeros;
    mantissa >>= zeros;  // leaves nothing out, and so rounds nothing
    for (; mantissa % 5 == 0; mantissa /= 5) ++fives;
    end = write_integer(end, mantissa, 16);
  } else {
    mpz_class mantissa = number.mantissa();
    const mp_bitcnt_t zeros = mpz_scan1(mantissa.get_mpz_t(), 0);
    mantissa >>= zeros;
    twos += static_cast<std::int64_t>(zeros);
    const mpz_class five = 5;
    fives += static_cast<std::int64_t>(
        mpz_remove(mantissa.get_mpz_t(), mantissa.get_mpz_t(), five.get_mpz_t()));
    text += mantissa.get_str(16);
  }
  *end++ = ':';
  end = write_integer(end, twos);
  *end++ = ':';
  end = write_integer(end, fives);
  text.append(buffer, end);
}

void append_loop(std::string& text, const std::vector<VertexId>& loop) {
  for (const VertexId vertex : loop) {
    char buffer[kDigits + 1] = {' '};
    text.append(buffer, write_integer(buffer + 1, vertex));
  }
  text += '\n';
}

}  // namespace

std::string geometry_digest(const Scene& scene) {
  Sha256 hash;
  std::string text = "gnomon-geometry 1\n";
  const auto pass_on = [&] {
    constexpr std::size_t kEnough = std::size_t{1} << 16;
    if (text.size() < kEnough) return;
    hash.add(text);
    text.clear();
  };
  for (const Position& vertex : scene.vertices) {
    text += 'v';
    for (const Number& number : vertex) {
      text += ' ';
      append_canonical(text, number);
    }
    text += '\n';
    pass_on();
  }
  for (const Polygon& polygon : scene.polygons) {
    text += "p ";
    const bool two_sided = scene.is_two_sided(polygon);
    if (polygon.casts) text += 'c';
    if (two_sided) text += 't';
    if (!polygon.casts && !two_sided) text += '-';
    append_loop(text, polygon.loop);
    for (const auto& hole : polygon.holes) {
      text += 'h';
      append_loop(text, hole);
    }
    pass_on();
  }
  hash.add(text);
  return "sha256:" + hash.hex();
}

}  // namespace gnomon
