#include <pantin/bridge/loaders/urdf_parse.hpp>

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <exception>
#include <mutex>
#include <utility>

namespace pantin::urdf_loader {
namespace {

/// Collects what urdfdom says while it lives, and gives the console back.
class Capture : public console_bridge::OutputHandler {
 public:
  explicit Capture(Ledger& ledger) : ledger_{ledger}, previous_{console_bridge::getOutputHandler()} {
    console_bridge::useOutputHandler(this);
  }
  ~Capture() override { console_bridge::useOutputHandler(previous_); }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level < console_bridge::CONSOLE_BRIDGE_LOG_WARN) return;
    ledger_.alike(Severity::Warning, "urdfdom", {0, "urdfdom", text, ""});
  }

 private:
  Ledger& ledger_;
  console_bridge::OutputHandler* previous_;
};

/// Holds a model and frees it without the recursion from link to child link that would overflow the stack on
/// a long chain.
std::shared_ptr<urdf::ModelInterface> freed_flat(urdf::ModelInterfaceSharedPtr parsed) {
  urdf::ModelInterface* model = parsed.get();
  return {model, [parsed = std::move(parsed)](urdf::ModelInterface* freed) {
            for (const auto& [name, link] : freed->links_) {
              link->child_links.clear();
              link->child_joints.clear();
            }
          }};
}

}  // namespace

std::shared_ptr<urdf::ModelInterface> parse_urdf(const std::string& xml, Ledger& ledger) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock{one_at_a_time};
  const Capture capture{ledger};
  try {
    if (auto parsed = urdf::parseURDF(xml)) return freed_flat(std::move(parsed));
    ledger.error({0, "urdfdom", "refuses this robot", "see its messages"});
  } catch (const std::exception& e) {
    ledger.error({0, "urdfdom", std::string{"fails: "} + e.what(), ""});
  }
  return nullptr;
}

}  // namespace pantin::urdf_loader
