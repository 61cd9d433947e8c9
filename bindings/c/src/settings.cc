// asperity_settings of asperity_feel.h.

#include <string>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/base/unknown_setting.h"
#include "handles.h"
#include "status.h"

namespace {

using asperity::c_library::BadArgument;
using asperity::c_library::guarded;
using asperity::c_library::there;

// The renderer's, and the rate, which the command line has among those of its servo.
std::vector<asperity::ConfigField> fields_of(asperity::RenderConfig& render) {
  struct Rate {
    double& rate_Hz;
    void visit(asperity::ConfigLister& lister) {
      lister.field("rate_Hz", rate_Hz, "steps a second, Hz", {100.0, 20000.0});
    }
  } rate{render.texture.rate_Hz};
  std::vector<asperity::ConfigField> out = asperity::list_fields("", render);
  asperity::ConfigLister lister;
  rate.visit(lister);
  for (asperity::ConfigField& field : lister.take()) out.push_back(std::move(field));
  return out;
}

// Names and meanings, once: they are the library's as long as it is loaded.
struct Setting {
  std::string name, help;
};

const std::vector<Setting>& settings_known() {
  static const std::vector<Setting> known = [] {
    asperity::RenderConfig render;
    std::vector<Setting> out;
    for (const asperity::ConfigField& field : fields_of(render)) out.push_back({field.path, field.description});
    return out;
  }();
  return known;
}

}  // namespace

extern "C" {

asperity_status asperity_settings_create(asperity_settings** settings) {
  if (settings != nullptr) *settings = nullptr;
  return guarded([&] {
    asperity_settings*& out = there(settings, "settings");
    out = new asperity_settings{};
  });
}

void asperity_settings_free(asperity_settings* settings) { delete settings; }

asperity_status asperity_settings_set(asperity_settings* settings, const char* name, const char* value) {
  return guarded([&] {
    asperity::RenderConfig changed = there(settings, "settings").render;
    try {
      asperity::set_field(fields_of(changed), &there(name, "name"), &there(value, "value"));
    } catch (const asperity::UnknownSetting& fault) {
      throw BadArgument(std::string(fault.what()) +
                        (fault.names_nearest() ? "" : "; asperity_settings_name() lists them"));
    } catch (const asperity::Error& fault) {
      throw BadArgument(fault.what());
    }
    settings->render = changed;
  });
}

size_t asperity_settings_count(void) {
  std::size_t count = 0;
  guarded([&] { count = settings_known().size(); });
  return count;
}

const char* asperity_settings_name(size_t setting) {
  return setting < asperity_settings_count() ? settings_known()[setting].name.c_str() : nullptr;
}

const char* asperity_settings_help(size_t setting) {
  return setting < asperity_settings_count() ? settings_known()[setting].help.c_str() : nullptr;
}
}
