// btr-camera fit: lens numbers from photographs of a board.
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/camera/camera_commands.h"
#include "core/camera/point_files.h"
#include "core/spec/error.h"
#include "core/spec/file_ending.h"
#include "core/spec/json_reader.h"

namespace btr::cli {
namespace {

namespace fs = std::filesystem;

struct FitArguments {
  std::string board, photos, points, poses, camera, out;
  double square_m = 0.025;
  TwinOptions options;
};

BoardPattern boardOf(const FitArguments& a) {
  int columns = 0, rows = 0;
  char end = 0;
  const bool read = std::sscanf(a.board.c_str(), "%dx%d%c", &columns, &rows, &end) == 2;
  if (!read || columns < 3 || rows < 3 || columns > 100 || rows > 100)
    throw InputError("--board", "\"" + a.board + "\"", "inner corners COLUMNSxROWS, 3 to 100 each, for example 9x6");
  return {columns, rows, a.square_m};
}

/// The board in each photograph; those that do not show all of it are named in `unseen`.
std::vector<PointView> boardViews(const FitArguments& a, const CameraSpec& spec, const Shell& shell,
                                  std::vector<std::string>& unseen) {
  const BoardPattern board = boardOf(a);
  std::vector<PointView> views;
  for (const std::string& path : picturesIn(a.photos)) {
    if (*shell.stop) throw InputError("stopped before anything was written");
    const RgbPicture photo = readPicture(path);
    if (photo.width != spec.width || photo.height != spec.height)
      throw InputError(path, std::to_string(photo.width) + "x" + std::to_string(photo.height) + " pixels",
                       "the " + std::to_string(spec.width) + "x" + std::to_string(spec.height) + " of " + a.camera);
    const std::string name = fs::path(path).filename().string();
    if (auto view = boardView(photo, board, name))
      views.push_back(std::move(*view));
    else
      unseen.push_back(name);
  }
  for (const std::string& name : unseen)
    std::fprintf(stderr, "%s: the board's %s corners are not all found; left out\n", name.c_str(), a.board.c_str());
  return views;
}

void addPoses(std::vector<PointView>& views, const std::string& path, const CameraSpec& spec, bool isBoard) {
  const std::map<std::string, ViewPose> poses = readPoses(path);
  for (PointView& view : views) {
    const auto pose = poses.find(view.name);
    if (pose == poses.end()) throw InputError(path + ": has no pose of " + view.name);
    view = withPose(std::move(view), pose->second, spec, isBoard);
  }
}

void fitLensCommand(const FitArguments& a, const Shell& shell) {
  const CameraSpec spec = loadCamera(a.camera);
  const bool isBoard = a.points.empty();
  if (isBoard && (a.board.empty() || a.photos.empty()))
    throw InputError("what is seen", "neither", "--board with --photos, or --points");
  std::vector<std::string> unseen;
  std::vector<PointView> views = isBoard ? boardViews(a, spec, shell, unseen) : readPoints(a.points);
  if (!a.poses.empty()) addPoses(views, a.poses, spec, isBoard);
  const CameraTwin twin = fitLens(spec, views, a.options);
  writeFile(a.out, toJsonText(twin.spec));
  printTwin(twin, "px", shell, {{"left_out", unseen}, {"camera", a.out}});
}

}  // namespace

std::vector<std::string> picturesIn(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> paths;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string ending = fileEnding(entry.path());
    if (ending == ".png" || ending == ".jpg" || ending == ".jpeg" || ending == ".bmp")
      paths.push_back(entry.path().string());
  }
  if (error) throw InputError(folder + ": cannot be read (" + error.message() + ")");
  if (paths.empty()) throw InputError(folder + ": has no picture (.png, .jpg, .jpeg, .bmp)");
  std::sort(paths.begin(), paths.end());
  return paths;
}

void printTwin(const CameraTwin& twin, const std::string& unit, const Shell& shell, const nlohmann::json& further) {
  if (shell.json) {
    nlohmann::json document = further, numbers = nlohmann::json::array(), photos = nlohmann::json::array();
    for (const TwinNumber& n : twin.numbers)
      numbers.push_back({{"name", n.name},
                         {"unit", n.unit},
                         {"before", n.before},
                         {"after", n.after},
                         {"deviation", n.deviation},
                         {"identified", n.identified}});
    for (const TwinPhoto& p : twin.photos)
      photos.push_back({{"name", p.name}, {"held_out", p.heldOut}, {"before", p.before}, {"after", p.after}});
    document["numbers"] = numbers;
    document["photos"] = photos;
    document["error_unit"] = unit;
    document["held_out"] = {{"before", twin.heldOutBefore}, {"after", twin.heldOutAfter}};
    document["fitted"] = {{"after", twin.fittedAfter}};
    if (twin.noise > 0) document["noise"] = twin.noise;
    return printJson(document);
  }
  std::vector<std::vector<std::string>> rows;
  for (const TwinNumber& n : twin.numbers)
    rows.push_back({n.name, digits(n.before, 4), digits(n.after, 5), "± " + digits(n.deviation, 2), n.unit,
                    n.identified ? "" : "not told by these photographs"});
  std::cout << table({"number", "before", "after", "", "", ""}, rows) << '\n';
  rows.clear();
  for (const TwinPhoto& p : twin.photos)
    rows.push_back({p.name, p.heldOut ? "held out" : "fitted", digits(p.before, 3), digits(p.after, 3)});
  std::cout << table({"photograph", "", "before [" + unit + "]", "after"}, rows);
  std::cout << "\nHeld out: " << digits(twin.heldOutBefore, 3) << " " << unit << " before, "
            << digits(twin.heldOutAfter, 3) << " after (root mean square)";
  if (twin.noise > 0) std::cout << "; noise alone " << digits(twin.noise, 3);
  std::cout << ".\n";
}

void addFitCommand(CLI::App& app, Shell& shell) {
  auto a = std::make_shared<FitArguments>();
  CLI::App* fit = app.add_subcommand("fit", "focal length, centre and lens from photographs of a chessboard");
  CLI::Option* board = fit->add_option("--board", a->board, "its inner corners, for example 9x6");
  fit->add_option("--square_m", a->square_m, "side of a square [m]")
      ->transform(decimalNumber(1e-4, 10))
      ->capture_default_str();
  CLI::Option* photos = fit->add_option("--photos", a->photos, "folder of photographs")->needs(board);
  fit->add_option("--points", a->points, "table of points and their pixels instead (CSV)")
      ->excludes(board)
      ->excludes(photos);
  fit->add_option("--poses", a->poses, "table of where the camera was, if that was measured (CSV)");
  fit->add_option("--camera", a->camera, "the camera as it is thought to be")->required();
  fit->add_option("--held-out", a->options.heldOutShare, "share of the photographs that no fit sees")
      ->transform(decimalNumber(0.01, 0.9))
      ->capture_default_str();
  fit->add_option("--seed", a->options.seed, "which those are")->transform(seedNumber())->capture_default_str();
  shell.writesFile(fit, fit->add_option("--out", a->out, "writes the camera as it was found")->required());
  fit->callback([a, &shell] { fitLensCommand(*a, shell); });
}

}  // namespace btr::cli
