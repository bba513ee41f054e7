// Runs a fuzzer without libFuzzer: on every file of a folder, and on damaged copies of each, always
// the same ones. For compilers and sanitizers that have no fuzzer, and for every run of the tests.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr int kCopies = 1000;

void Run(const std::string& bytes) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

/// Overwrites, cuts out, repeats or ends somewhere.
std::string Damaged(std::string bytes, std::minstd_rand& random) {
  for (unsigned damages = 1 + random() % 4; damages > 0 && !bytes.empty(); --damages) {
    const std::size_t at = random() % bytes.size();
    const std::size_t length = 1 + random() % 8;
    switch (random() % 4) {
      case 0:
        bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes.erase(at, length);
        break;
      case 2:
        bytes.insert(at, bytes.substr(random() % bytes.size(), length));
        break;
      default:
        bytes.resize(at);
    }
  }
  return bytes;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1])) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    Run(bytes);
    std::minstd_rand random(1);
    for (int copy = 0; copy < kCopies; ++copy) Run(Damaged(bytes, random));
    ++files;
  }
  std::printf("%d files, each with %d damaged copies\n", files, kCopies);
  return files > 0 ? 0 : 2;
}
