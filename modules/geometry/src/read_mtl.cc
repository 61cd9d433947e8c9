#include "asperity/geometry/read_mtl.h"

#include <cmath>
#include <optional>
#include <unordered_map>

#include "asperity/base/error.h"
#include "asperity/base/inner_path.h"
#include "asperity/base/text.h"
#include "problem_counter.h"
#include "statement_lines.h"

namespace asperity {

namespace {

constexpr std::size_t kMaxMaterialLine = 64 * 1024;

bool is_number(std::string_view word) { return parse_double(word).has_value(); }

// How many words the option of a texture statement takes after itself, 0 if it is none; `rest` follows it.
std::size_t option_words(std::string_view option, std::string_view rest) {
  for (const char* one :
       {"-blendu", "-blendv", "-bm", "-boost", "-cc", "-clamp", "-colorspace", "-imfchan", "-texres", "-type"}) {
    if (option == one) return 1;
  }
  if (option == "-mm") return 2;
  if (option != "-o" && option != "-s" && option != "-t") return 0;
  std::size_t words = 0;
  while (words < 3 && is_number(next_word(rest))) ++words;
  return words;
}

class MtlParser {
 public:
  MtlParser(std::string_view text, const std::string& name)
      : lines_(text, name, kMaxMaterialLine), problems_(library_.problems) {}

  MaterialLibrary parse() {
    while (lines_.next()) statement();
    return std::move(library_);
  }

 private:
  void statement() {
    const std::string_view keyword = lines_.keyword();
    if (keyword == "newmtl") {
      begin();
    } else if (material_ == nullptr) {
      damaged("is before the first 'newmtl'");
    } else if (keyword == "Kd") {
      colour();
    } else if (keyword == "map_Kd") {
      texture(material_->base_colour_map);
    } else if (keyword == "norm" || keyword == "map_Norm") {
      texture(material_->normal_map);
    } else if (keyword == "bump" || keyword == "map_bump" || keyword == "map_Bump") {
      texture(material_->bump_map);
    } else if (keyword == "disp" || keyword == "map_disp") {
      texture(material_->displacement_map);
    } else {
      problems_.count("material_statement", [&] {
        return lines_.place() + ": '" + printable(keyword) + "' and what else a mesh does not keep of a material";
      });
    }
  }

  void damaged(const std::string& why) {
    problems_.count("material_line", [&] { return lines_.place() + ": '" + printable(lines_.keyword()) + "' " + why; });
  }

  void begin() {
    const std::string name(lines_.rest());
    const bool is_new = !name.empty() && names_.try_emplace(name, library_.materials.size()).second;
    if (!is_new) damaged(name.empty() ? "without a name" : "names '" + printable(name) + "' again; the first is kept");
    ignored_.name = name;
    if (is_new) library_.materials.emplace_back().name = name;
    material_ = is_new ? &library_.materials.back() : &ignored_;
  }

  void colour() {
    std::string_view rest = lines_.rest();
    Eigen::Vector3d rgb;
    int count = 0;
    for (; count < 3; ++count) {
      const std::optional<double> value = parse_double(next_word(rest));
      if (!value || !std::isfinite(*value)) break;
      rgb[count] = *value;
    }
    if (count == 1) rgb = Eigen::Vector3d::Constant(rgb[0]);  // one number stands for all three
    if (count == 0 || count == 2) return damaged("is not a colour: '" + printable(lines_.rest()) + "'");
    material_->base_colour = rgb;
  }

  void texture(std::string& map) {
    std::string_view rest = lines_.rest();
    std::string_view name;
    // Options stand before the name, or after it in some files; the name may have blanks.
    for (std::string_view ahead = rest; !ahead.empty();) {
      const std::string_view before = trim(ahead);
      std::string_view after = before;
      const std::string_view word = next_word(after);
      const std::size_t words = option_words(word, after);
      if (words == 0) {
        if (name.empty()) name = before;
        ahead = after;
        continue;
      }
      problems_.count("texture_option",
                      [&] { return lines_.place() + ": the option " + printable(word) + " is not kept"; });
      if (!name.empty() && name.data() + name.size() > before.data())
        name = trim(name.substr(0, static_cast<std::size_t>(before.data() - name.data())));
      if (!name.empty()) break;
      for (std::size_t i = 0; i < words; ++i) next_word(after);
      ahead = after;
    }
    if (name.empty()) return damaged("without a file name");
    const std::optional<std::string> inner = inner_path(name);
    if (!inner) {
      problems_.count("outside_path",
                      [&] { return lines_.place() + ": '" + printable(name) + "' leads out of the folder"; });
      return;
    }
    map = *inner;
  }

  StatementLines lines_;
  MaterialLibrary library_;
  ProblemCounter problems_;
  std::unordered_map<std::string, std::size_t> names_;
  MeshMaterial ignored_;
  MeshMaterial* material_ = nullptr;
};

}  // namespace

MaterialLibrary parse_mtl(std::string_view text, const std::string& name) { return MtlParser(text, name).parse(); }

}  // namespace asperity
