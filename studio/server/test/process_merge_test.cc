#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "asperity/json/parse_json.h"
#include "asperity/pipeline/merge_results.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/write_result.h"
#include "asperity/profile/merge_gain.h"
#include "asperity/recording/read_recording.h"
#include "asperity/recording/write_recording.h"
#include "asperity/session/register_input.h"
#include "asperity/session/rendered_input.h"
#include "asperity/simulation/simulate_recording.h"
#include "page_rig.h"
#include "process/merge_strokes.h"
#include "process/process_page.h"
#include "read_block.h"

namespace asperity::studio {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream out;
  out << stream.rdbuf();
  return out.str();
}

// A stroke of 40 mm; those of one line follow a guide over one relief.
void store_stroke(const fs::path& folder, std::int64_t line, int seed) {
  SimulationConfig config = make_simulation_config("sandpaper", "open");
  config.hand.length_m = 0.04;
  config.hand.path_seed = line;
  config.surface.seed = line;
  config.seed = seed;
  fs::create_directories(folder);
  write_recording(folder, simulate_recording(config));
}

class ProcessMergeTest : public ::testing::Test, protected PageRig<> {
 protected:
  ProcessMergeTest() {
    store_stroke(folder / "a", 1, 11);
    store_stroke(folder / "b", 1, 12);
    open(make_process_page(shared));
  }

  void choose(std::initializer_list<const char*> strokes) {
    Json names = Json::array();
    for (const char* stroke : strokes) names.push_back(stroke);
    document.edit("/process/merge/strokes", names, "choose");
  }

  // As the command line has it: from the files, stage by stage.
  ProcessResult expected(const MergeConfig& config) const {
    ProcessConfig each = config.process;
    each.profile.remove_noise = false;
    std::vector<MergeStroke> strokes;
    std::vector<StrokeSource> sources;
    for (const char* name : {"a", "b"}) {
      const Recording recording = read_recording(folder / name);
      strokes.push_back(stroke_of_result(process_recording(recording, each), recording, name));
      sources.push_back(source_of(folder / name, recording, name));
    }
    ProcessResult result = merge_results(strokes, read_recording(folder / "a").info.object, config);
    if (result.texture) note_sources(*result.texture, sources);
    return result;
  }
};

TEST_F(ProcessMergeTest, MergesAndWritesAsTheCommandLine) {
  choose({"a", "b"});
  document.edit("/process/merge/config/align.knot_spacing_m", "0.008", "tune");
  document.edit("/process/config/profile.cutoff_cycles_per_mm", "0.2", "tune");
  const FakeHub::Answer answer = call("process.merge");
  ASSERT_EQ(answer.error, "");
  const ReadBlock block(answer.block);

  MergeConfig config;
  config.align.knot_spacing_m = 0.008;
  config.process.profile.cutoff_cycles_per_mm = 0.2;
  const ProcessResult result = expected(config);
  const std::string object = read_recording(folder / "a").info.object;
  ASSERT_TRUE(result.passes->agrees);
  EXPECT_EQ(block.head["result"], parse_json(merge_json(result, config, object).dump_repaired(2)));  // nan is null
  EXPECT_EQ(block.head["gain"]["share"].get<double>(), merge_gain(*result.passes, config.align).share);
  const std::vector<float> strokes = block.array<float>("stroke_texture_m");
  ASSERT_EQ(strokes.size(), 2 * result.profile.size());
  const std::size_t middle = result.profile.size() / 2;
  EXPECT_EQ(strokes[middle], static_cast<float>(result.passes->passes[0].texture_m[middle]));
  EXPECT_EQ(block.array<float>("profile_texture_m")[middle], static_cast<float>(result.profile.texture_m[middle]));

  ASSERT_EQ(call("process.write_merge", Json{{"name", "merged"}}).error, "");
  fs::create_directories(folder / "by_hand");
  write_merge(folder / "by_hand", result, config, object);
  for (const char* file : {"result.json", "profile.csv", "spectrum.csv", "texture.json"}) {
    ASSERT_FALSE(content(folder / "by_hand" / file).empty()) << file;
    EXPECT_TRUE(content(folder / "merged" / file) == content(folder / "by_hand" / file)) << file;
  }
  // What is there is only replaced if it is stated; and never something else than results.
  EXPECT_THAT(call("process.write_merge", Json{{"name", "merged"}}).error, HasSubstr("exists already"));
  EXPECT_EQ(call("process.write_merge", Json{{"name", "merged"}, {"replace", true}}).error, "");
  EXPECT_NE(call("process.write_merge", Json{{"name", "a"}, {"replace", true}}).error, "");
  EXPECT_TRUE(fs::exists(folder / "a" / "recording.json"));
}

TEST_F(ProcessMergeTest, RefusesInWordsAndWritesNothing) {
  choose({"a"});
  EXPECT_THAT(call("process.merge").error, HasSubstr("at least two strokes"));
  choose({"a", "nowhere"});
  EXPECT_THAT(call("process.merge").error, HasSubstr("nowhere"));
  choose({"a", "../b"});
  EXPECT_NE(call("process.merge").error, "");
  // A result whose noise was removed.
  fs::create_directories(folder / "done");
  const Recording recording = read_recording(folder / "a");
  write_result(folder / "done", process_recording(recording, {}), recording, "a");
  choose({"done", "b"});
  EXPECT_THAT(call("process.merge").error, HasSubstr("done/result.json: the noise was removed"));
  // Another line: the verdict is shown, and there is nothing to write.
  store_stroke(folder / "c", 2, 13);
  choose({"a", "c"});
  const FakeHub::Answer apart = call("process.merge");
  ASSERT_EQ(apart.error, "");
  const Json head = ReadBlock(apart.block).head;
  EXPECT_FALSE(head["result"]["trustworthy"].get<bool>());
  EXPECT_THAT(head["result"]["verdict"].get<std::string>(), HasSubstr("did not pass over the same line"));
  EXPECT_THAT(call("process.write_merge", Json{{"name", "none"}}).error, HasSubstr("same line"));
  EXPECT_FALSE(fs::exists(folder / "none"));
  std::ofstream(folder / "c" / "probe.csv") << "nonsense\n";
  EXPECT_THAT(call("process.merge").error, HasSubstr("c/probe.csv"));
}

TEST_F(ProcessMergeTest, IsCancelled) {
  choose({"a", "b"});
  const std::uint64_t keeps_busy = begin("process.run", Json{{"recording", "a"}});
  const std::uint64_t merging = begin("process.merge");
  for (const Json& job : call("job.list").result) {
    if (job["title"] == "Merge strokes") call("job.cancel", Json{{"job", job["id"]}});
  }
  EXPECT_EQ(answer_to(merging).error, "cancelled");
  EXPECT_EQ(answer_to(keeps_busy).error, "");
  // One that is under way ends between two strokes and within them.
  for (const int after : {0, 1, 3}) {
    ScanSessions sessions;
    int asked = 0;
    const Observer observer{{}, [&] { return asked++ >= after; }};
    EXPECT_THROW(merge_strokes({{"a", folder / "a"}, {"b", folder / "b"}}, {}, sessions, observer), Cancelled) << after;
  }
}

TEST_F(ProcessMergeTest, TheDocumentHoldsNamesAndSettingsOfTheAlignment) {
  EXPECT_FALSE(call("process.fields").result["merge_fields"].empty());
  for (const char* edit :
       {R"(["/process/merge/strokes", "a"])", R"(["/process/merge/strokes", [1]])",
        R"(["/process/merge/config/process.method", "raw"])", R"(["/process/merge/config/align.max_stretch", "2"])",
        R"(["/process/merge/what", 1])", R"(["/process/merge", []])"}) {
    const Json json = parse_json(edit);
    EXPECT_THROW(document.edit(json[0].get<std::string>(), json[1], "bad"), Error) << edit;
  }
}

}  // namespace
}  // namespace asperity::studio
