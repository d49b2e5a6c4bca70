// SPDX-License-Identifier: GPL-3.0-or-later
// fuzz_seeds FOLDER SCENE...: writes the codes (gnomon/fuzz/scene_code.h) of scenes to a folder,
// one for each light, to start fuzzing from. Scenes that have no code, or cannot be read, are left
// out.
//
// fuzz_seeds --show CODE: prints the scene of a code as JSON, within the default limits. Targets
// may have room for fewer polygons and vertices.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string_view>

#include "fuzz/generate/scene_code.h"
#include "gnomon/scene/read.h"
#include "gnomon/scene/write.h"
#include "scene/base/output_file.h"
#include "scene/base/text_file.h"

namespace {

int show(const char* file) {
  using namespace gnomon;
  const auto code = read_file(file);
  if (!code) {
    std::fprintf(stderr, "%s\n", to_string(code.error()).c_str());
    return 1;
  }
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(code->data());
  const auto text = scene_to_text(fuzz::scene_from_code({bytes, code->size()}), SceneFormat::kJson);
  std::fputs(text ? text->text.c_str() : to_string(text.error()).c_str(), stdout);
  return text ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace gnomon;
  if (argc == 3 && std::string_view(argv[1]) == "--show") return show(argv[2]);
  if (argc < 3) {
    std::fprintf(stderr, "usage: fuzz_seeds FOLDER SCENE...\n       fuzz_seeds --show CODE\n");
    return 2;
  }
  int written = 0;
  for (int i = 2; i < argc; ++i) {
    const std::filesystem::path file = argv[i];
    const auto read = read_scene(file);
    if (!read) continue;
    for (std::size_t light = 0; light < read->scene.lights.size(); ++light) {
      Scene scene = read->scene;
      scene.lights = {read->scene.lights[light]};
      const auto code = fuzz::code_of_scene(scene);
      if (!code) continue;
      const auto path =
          std::filesystem::path(argv[1]) / (file.stem().string() + '-' + std::to_string(light));
      const std::string_view text(reinterpret_cast<const char*>(code->data()), code->size());
      if (const auto done = write_file(path, text); !done) {
        std::fprintf(stderr, "%s\n", to_string(done.error()).c_str());
        return 1;
      }
      ++written;
    }
  }
  std::printf("%d codes\n", written);
}
