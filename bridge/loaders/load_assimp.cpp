#include <pantin/bridge/loaders/load_assimp.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstring>
#include <exception>
#include <system_error>

#include <pantin/bridge/input_file.hpp>
#include <pantin/bridge/loaders/import_place.hpp>
#include <pantin/bridge/loaders/import_process.hpp>
#include <pantin/bridge/loaders/import_wire.hpp>

namespace pantin {
namespace {

constexpr std::uintmax_t kMaxBytes = std::uintmax_t{2} << 30;
constexpr const char* kCheckFile = "check that the file opens in the program that wrote it";

/// assimp 5.2's; a test compares them with those of the assimp in use.
constexpr std::array<std::string_view, 70> kExtensions{
    ".3d",  ".3ds",   ".3mf", ".ac",      ".ac3d",      ".acc",     ".amf",  ".ase",     ".ask",  ".assbin",
    ".b3d", ".blend", ".bsp", ".bvh",     ".cob",       ".csm",     ".dae",  ".dxf",     ".enff", ".fbx",
    ".glb", ".gltf",  ".hmp", ".ifc",     ".ifczip",    ".iqm",     ".irr",  ".irrmesh", ".lwo",  ".lws",
    ".lxo", ".md2",   ".md3", ".md5anim", ".md5camera", ".md5mesh", ".mdc",  ".mdl",     ".mesh", ".mesh.xml",
    ".mot", ".ms3d",  ".ndo", ".nff",     ".obj",       ".off",     ".ogex", ".pk3",     ".ply",  ".pmx",
    ".prj", ".q3o",   ".q3s", ".raw",     ".scn",       ".sib",     ".smd",  ".step",    ".stl",  ".stp",
    ".ter", ".uc",    ".vta", ".x",       ".x3d",       ".x3db",    ".xgl",  ".xml",     ".zae",  ".zgl"};

/// The limits for one file.
struct Limits {
  double cpu_s;
  double wall_s;
  std::uint64_t memory_bytes;
};
Limits limits_for(const ImportSettings& settings, std::uintmax_t bytes) {
  const double cpu = settings.cpu_s > 0 ? settings.cpu_s : 4 + static_cast<double>(bytes) / 1e6;
  return {cpu, settings.wall_s > 0 ? settings.wall_s : 4 * cpu,
          settings.memory_bytes > 0 ? settings.memory_bytes : (std::uint64_t{512} << 20) + 100 * bytes};
}

std::string text_of(double seconds) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), seconds,
                                 std::chars_format::fixed, seconds < 10 ? 1 : 0);
  return {buffer.data(), end.ptr};
}

/// "SIGSEGV", and what it means.
std::string signal_text(int signal) {
  const char* name = sigabbrev_np(signal);
  const char* meaning = sigdescr_np(signal);
  return (name != nullptr ? std::string{"SIG"} + name : "signal " + std::to_string(signal)) +
         (meaning != nullptr ? std::string{" ("} + meaning + ')' : "");
}

Diagnostic failure(const std::filesystem::path& file, std::string problem, std::string remedy) {
  return {Severity::Error, file.string(), "file", std::move(problem), std::move(remedy)};
}

Diagnostic missing(const std::filesystem::path& file, const ImportHelper& helper) {
  std::string places;
  for (const std::filesystem::path& tried : helper.tried)
    places += (places.empty() ? "" : ", ") + tried.string();
  return failure(file, "needs the helper pantin-import, which is not there; looked for " + places,
                 "install it, or name it in the environment variable PANTIN_IMPORT");
}

/// Why there is no answer; nothing where there may be one.
std::optional<Diagnostic> problem_with(const ProcessResult& ran, const std::filesystem::path& file,
                                       const std::filesystem::path& helper, const Limits& limits) {
  const std::string raise = "; or allow it more (ImportSettings)";
  switch (ran.end) {
    case ProcessEnd::NotStarted:
      return failure(file,
                     "the helper " + helper.string() + " cannot be started: " + std::strerror(ran.detail),
                     "check that it may be executed");
    case ProcessEnd::Signalled:
      if (ran.detail == SIGXCPU) {
        return failure(file, "its parser met the limit of " + text_of(limits.cpu_s) + " s of CPU time",
                       kCheckFile + raise);
      }
      return failure(file, "its parser crashed: " + signal_text(ran.detail), kCheckFile);
    case ProcessEnd::TimedOut:
      return failure(file, "its parser met the limit of " + text_of(limits.wall_s) + " s of elapsed time",
                     kCheckFile + raise);
    case ProcessEnd::TooMuch:
      return failure(file, "its parser makes more than 2 GiB of it", kCheckFile);
    case ProcessEnd::Exited:
      if (ran.detail == 0) return std::nullopt;
      return failure(file, "the helper " + helper.string() + " ended with code " + std::to_string(ran.detail),
                     "use the pantin-import that was built with this library");
    case ProcessEnd::Unseen:
      break;  // what it wrote decides
  }
  return std::nullopt;
}

/// What the helper printed, line by line: the first few, and how many more.
void note_noise(const std::string& noise, const std::string& place, std::vector<Diagnostic>& notes) {
  constexpr int kMost = 3;
  int lines = 0;
  std::string shown;
  for (std::size_t at = 0; at < noise.size();) {
    const std::size_t end = std::min(noise.find('\n', at), noise.size());
    if (end > at && ++lines <= kMost) shown += (shown.empty() ? "" : " | ") + noise.substr(at, end - at);
    at = end + 1;
  }
  if (lines == 0) return;
  if (lines > kMost) shown += " (and " + std::to_string(lines - kMost) + " more lines)";
  notes.push_back({Severity::Note, place, "parser", "printed: " + shown, ""});
}

/// All that there is to say: which elements a file of that format has, and which of them assimp passed over,
/// is known to assimp alone.
void add_account(const Loaded<Model>& loaded, const std::string& place, Account& account) {
  std::size_t vertices = 0, triangles = 0, keys = 0;
  for (const ModelNode& node : loaded.value->nodes) {
    for (const ModelMesh& mesh : node.meshes) {
      vertices += mesh.mesh->vertices.size();
      triangles += mesh.mesh->triangles.size();
    }
  }
  for (const Clip& clip : loaded.value->clips)
    for (const Track& track : clip.tracks) keys += track.times.size();
  const auto add = [&](const char* what, std::size_t count) {
    if (count > 0) account.push_back({.place = place, .subject = "file", .item = what, .count = count});
  };
  add("nodes", loaded.value->nodes.size());
  add("vertices", vertices);
  add("triangles", triangles);
  add("keys of animations", keys);
  for (const Diagnostic& note : loaded.notes) {
    if (note.problem.find("drop") == std::string::npos) continue;
    account.push_back({.fate = Fate::Dropped, .place = place, .subject = note.subject, .why = note.problem});
  }
}

Loaded<Model> import(const std::filesystem::path& file, const LoadOptions& options) {
  const ImportSettings& settings = options.import;
  if (auto problem = problem_with_file(file, kMaxBytes)) return {{}, {*std::move(problem)}};
  if (const auto problem = problem_with(settings))
    return {{}, {failure(file, "the settings of the import are unusable: " + *problem, "mend them")}};
  const ImportHelper helper = find_import_helper(settings.helper);
  if (helper.path.empty()) return {{}, {missing(file, helper)}};
  std::error_code ignored;
  const Limits limits = limits_for(settings, std::filesystem::file_size(file, ignored));
  const std::array<std::string, 4> arguments{
      std::filesystem::absolute(file).string(), std::to_string(std::llround(std::ceil(limits.cpu_s))),
      std::to_string(limits.memory_bytes), options.geometry ? "geometry" : "hierarchy"};
  const ProcessResult ran = run_process(helper.path, arguments, {.wall_s = limits.wall_s});
  const std::string place = file.string();
  Loaded<Model> loaded;
  if (auto problem = problem_with(ran, file, helper.path, limits)) {
    loaded.notes.push_back(*std::move(problem));
  } else {
    loaded = decode(ran.result, place);
    for (Diagnostic& note : loaded.notes) note.place = place;  // one file, named as the caller named it
  }
  note_noise(ran.noise, place, loaded.notes);
  if (loaded.value && !has_error(loaded.notes)) {
    loaded.notes.push_back({Severity::Note, place, "file",
                            "is read by assimp, which does not tell what it passes over itself", ""});
    if (options.account != nullptr) add_account(loaded, place, *options.account);
  }
  return loaded;
}

}  // namespace

std::optional<std::string> problem_with(const ImportSettings& settings) {
  const auto is_time = [](double t) { return t >= 0 && t <= 1e6; };
  if (!is_time(settings.cpu_s)) return "cpu_s is not between 0 and 1e6 s";
  if (!is_time(settings.wall_s)) return "wall_s is not between 0 and 1e6 s";
  if (settings.memory_bytes != 0 && settings.memory_bytes < (std::uint64_t{64} << 20))
    return "memory_bytes is below 64 MiB";
  return std::nullopt;
}

Loaded<Model> load_assimp(const std::filesystem::path& file, const LoadOptions& options) {
  try {
    return import(file, options);
  } catch (const std::exception& e) {
    return {{}, {failure(file, std::string{"cannot be read: "} + e.what(), "")}};
  }
}

std::span<const std::string_view> assimp_extensions() { return kExtensions; }

bool assimp_reads(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  return extension != ".xml" && std::binary_search(kExtensions.begin(), kExtensions.end(), extension);
}

}  // namespace pantin
