// How long a camera's stages take: each alone, all together, none; one round after the other, so that a busy machine
// is busy for all of them. Milliseconds of CPU time a frame, median of the rounds.
#include <algorithm>
#include <cstdio>

#include "core/camera/camera_pipeline.h"
#include "core/sim/bench/bench.h"

namespace {

using namespace btr;

struct Candidate {
  std::string name;
  CameraPipeline camera;
  std::vector<PinholePicture> moments;
  std::vector<double> times_s;
};

std::vector<PinholePicture> colouredMoments(const CameraPipeline& camera) {
  PinholePicture picture;
  picture.pinhole = camera.pinhole();
  for (int y = 0; y < picture.pinhole.height; ++y)
    for (int x = 0; x < picture.pinhole.width; ++x) {
      for (const int value : {x, y, x + y}) picture.rgb.push_back(static_cast<float>(value % 200) / 200);
      picture.depth_m.push_back(1);
      picture.object.push_back(static_cast<std::uint16_t>(x / 30));
    }
  return std::vector<PinholePicture>(camera.moments_s().size(), picture);
}

void addCandidate(std::vector<Candidate>& candidates, const std::string& name, const CameraSpec& spec) {
  CameraPipeline camera(spec);
  std::vector<PinholePicture> moments = colouredMoments(camera);
  candidates.push_back({name, std::move(camera), std::move(moments), {}});
}

void measure(const std::string& file) {
  const CameraSpec given = loadCamera(file);
  CameraSpec none = given, all = given;
  for (const CameraStage stage : cameraStages()) {
    none[stage].on = false;
    all[stage].on = true;
  }
  std::vector<Candidate> candidates;
  addCandidate(candidates, "none (bytes, truth)", none);
  for (const CameraStage stage : cameraStages()) {
    CameraSpec one = none;
    one[stage].on = true;
    addCandidate(candidates, nameOf(stage), one);
  }
  addCandidate(candidates, "as shipped", given);
  addCandidate(candidates, "all", all);
  constexpr std::uint64_t rounds = 200;
  for (std::uint64_t round = 0; round < rounds; ++round)
    for (Candidate& c : candidates) {
      const double begin = threadSeconds();
      c.camera.process(c.moments, round);
      c.times_s.push_back(threadSeconds() - begin);
    }
  std::printf("%s\n", given.name.c_str());
  for (Candidate& c : candidates) {
    std::sort(c.times_s.begin(), c.times_s.end());
    std::printf("  %-20s %7.3f ms\n", c.name.c_str(), 1e3 * c.times_s[c.times_s.size() / 2]);
  }
}

}  // namespace

int main() {
  for (const char* name : {"ers7", "ers7-416x320"})
    measure(std::string(SOURCE_DIR "/resources/cameras/") + name + ".json");
}
