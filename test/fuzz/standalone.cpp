// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs a fuzz target on a fixed set of inputs: on each file given, or in a folder given, on random
// changes of those, and on random bytes.
//
//   standalone COUNT [FILE|FOLDER]...
//
// KINETRI_TEST_MULTIPLIER multiplies COUNT, the number of random inputs. An input on which the
// target stops the program is in ./fuzz-last-input: a fuzzer may run it alone, and so may this
// program.
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "fuzz/fuzz.h"

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t longest_random_input = 200;

std::vector<std::filesystem::path> files_of(const std::filesystem::path& path) {
  if (!std::filesystem::is_directory(path)) return {path};
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(path)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

Bytes contents_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    std::cerr << path << " cannot be opened\n";
    std::exit(2);
  }
  return {std::istreambuf_iterator<char>(in), {}};
}

Bytes last_input;

// The program is about to end; a handler that writes a file is as good as it needs to be.
extern "C" void keep_last_input(int /*signal*/) {
  std::ofstream("fuzz-last-input", std::ios::binary)
      .write(reinterpret_cast<const char*>(last_input.data()),
             static_cast<std::streamsize>(last_input.size()));
}

void run(Bytes input) {
  last_input = std::move(input);
  LLVMFuzzerTestOneInput(last_input.data(), last_input.size());
}

std::size_t below(std::mt19937_64& random, std::size_t end) {
  return static_cast<std::size_t>(random() % end);
}

Bytes random_bytes(std::mt19937_64& random) {
  Bytes bytes(below(random, longest_random_input));
  // Half of the inputs have small bytes only, which give small numbers.
  const std::uint64_t mask = random() % 2 == 0 ? 0xff : 0x07;
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() & mask);
  return bytes;
}

// A few bytes replaced, removed, inserted, or copied from elsewhere.
Bytes changed(Bytes bytes, const Bytes& other, std::mt19937_64& random) {
  for (std::size_t changes = 1 + below(random, 4); changes > 0; --changes) {
    const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(below(random, bytes.size() + 1));
    const auto rest = static_cast<std::size_t>(bytes.end() - place);
    switch (random() % 4) {
      case 0:
        if (rest > 0) *place = static_cast<std::uint8_t>(random());
        break;
      case 1:
        bytes.erase(place, place + static_cast<std::ptrdiff_t>(
                                       below(random, std::min<std::size_t>(rest, 8) + 1)));
        break;
      case 2:
        bytes.insert(place, static_cast<std::uint8_t>(random()));
        break;
      default: {
        const std::size_t from = below(random, other.size() + 1);
        const std::size_t length =
            below(random, std::min<std::size_t>(other.size() - from, 20) + 1);
        const auto begin = other.begin() + static_cast<std::ptrdiff_t>(from);
        bytes.insert(place, begin, begin + static_cast<std::ptrdiff_t>(length));
      }
    }
  }
  return bytes;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: " << argv[0] << " COUNT [FILE|FOLDER]...\n";
    return 2;
  }
  const char* multiplier = std::getenv("KINETRI_TEST_MULTIPLIER");
  const unsigned long count =
      std::stoul(argv[1]) * std::max(1UL, multiplier == nullptr ? 1UL : std::stoul(multiplier));
  std::signal(SIGABRT, keep_last_input);
  std::vector<Bytes> seeds;
  for (int i = 2; i < argc; ++i) {
    for (const auto& file : files_of(argv[i])) seeds.push_back(contents_of(file));
  }
  for (const Bytes& seed : seeds) run(seed);
  std::mt19937_64 random(1);
  for (unsigned long i = 0; i < count; ++i) {
    if (seeds.empty() || random() % 4 == 0) {
      run(random_bytes(random));
    } else {
      run(changed(seeds[below(random, seeds.size())], seeds[below(random, seeds.size())], random));
    }
  }
  std::cout << seeds.size() << " files and " << count << " random inputs passed\n";
  return 0;
}
