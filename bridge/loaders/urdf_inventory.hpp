#pragma once
// Accounts for all of a robot's XML. Every element is numbered before anything is done to the document; what
// is gone from the copy that urdfdom gets must have been dropped with a reason, or it is reported here.
#include <cstddef>
#include <string>
#include <vector>

#include <pantin/bridge/account.hpp>
#include <pantin/bridge/loaders/urdf_ledger.hpp>

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace pantin::urdf_loader {

/// The number of an element of the file; 0 for one that was put into the copy.
[[nodiscard]] std::size_t number_of(const tinyxml2::XMLElement& element);

/// Takes an element with all in it out of the copy.
void drop(tinyxml2::XMLElement& element, std::string why, Ledger& ledger);
void drop_attribute(tinyxml2::XMLElement& element, const std::string& name, std::string why, Ledger& ledger);

class Inventory {
 public:
  /// Numbers the elements, by their user data.
  explicit Inventory(tinyxml2::XMLDocument& document);

  /// Tells what became of everything, by what is left of the document and what the ledger was told. A loss
  /// that was not told becomes a warning. `account` may be null.
  void settle(const tinyxml2::XMLDocument& left, Ledger& ledger, Account* account) const;

 private:
  struct Attribute {
    std::string name{};
    std::string value{};
    int line{0};
  };
  /// An element, or a text between elements.
  struct Item {
    std::size_t parent{0};  ///< number of the element that it is in; 0 = the document
    int line{0};
    std::string segment{};  ///< "visual[1]": its tag, and its count among siblings of that tag
    std::string subject{};  ///< of <robot> and what stands directly in it; empty for what is deeper
    bool is_text{false};
    std::vector<Attribute> attributes{};
  };
  [[nodiscard]] const std::string& subject_of(std::size_t number) const;
  /// "link/visual[1]/origin", from the child of <robot> on.
  [[nodiscard]] std::string path_of(std::size_t number) const;
  class Settlement;

  std::vector<Item> items_{};  ///< by number, in the order of the file; the first stands for the document
};

}  // namespace pantin::urdf_loader
