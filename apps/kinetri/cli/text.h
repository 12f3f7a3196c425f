// SPDX-License-Identifier: GPL-3.0-or-later
//
// Text made from words and numbers. Compiled once, unlike what header-only formatting libraries
// do in each source.
#ifndef KINETRI_APPS_TEXT_H
#define KINETRI_APPS_TEXT_H

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace kinetri::app {

/// The shortest decimal number that reads back as `number`: "0.1", "25", "1e+100".
std::string shortest(double number);

/// A word, or a number as a word. Numbers of type double are written by `shortest`.
class Word {
 public:
  // NOLINTBEGIN(google-explicit-constructor)
  Word(std::string_view text) : text_(text) {}
  Word(const std::string& text) : text_(text) {}
  Word(const char* text) : text_(text) {}
  Word(double number) : text_(shortest(number)) {}
  Word(int number) : text_(std::to_string(number)) {}
  Word(unsigned number) : text_(std::to_string(number)) {}
  Word(long number) : text_(std::to_string(number)) {}
  Word(unsigned long number) : text_(std::to_string(number)) {}
  Word(long long number) : text_(std::to_string(number)) {}
  Word(unsigned long long number) : text_(std::to_string(number)) {}
  // NOLINTEND(google-explicit-constructor)

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// The words, one after the other.
std::string concat(std::initializer_list<Word> words);

/// The words with the separator between them.
std::string joined(std::span<const std::string> words, std::string_view separator);

/// @{
/// As printf writes the number with %.*f and %.*g.
std::string fixed(double number, int decimals);
std::string significant(double number, int digits);
/// @}

/// @{
/// The text with blanks before it, or after it, so that it has at least `width` characters.
std::string right_aligned(std::string text, std::size_t width);
std::string left_aligned(std::string text, std::size_t width);
/// @}

/// "1 point", "2 points": the number with its noun, whose plural has an s.
std::string counted(std::uint64_t number, std::string_view noun);

/// Writes the text to standard error.
void print_error(std::string_view text);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_TEXT_H
