#include "asperity/scene/parse_hmpg.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "bit_reader.h"
#include "haptic_parts.h"
#include "hmpg_layout.h"

namespace asperity {

namespace {

class HmpgParser {
 public:
  HmpgParser(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name + ": HMPG") {}

  HapticExperience run() {
    while (!bytes_.empty()) read_unit();
    if (!metadata_) fail("the initialization unit is missing");
    check_haptic_experience(out_, name_);
    if (out_.perceptions.size() != perception_count_) fail("the number of perceptions is not the stated one");
    for (const HapticPerception& perception : out_.perceptions)
      for (const HapticChannel& channel : perception.channels) check_haptic_channel(channel, name_);
    check_counts();
    return std::move(out_);
  }

 private:
  struct Place {
    std::size_t perception = 0, channel = 0;
    std::uint32_t perception_id = 0, channel_id = 0;
  };

  // A file that lost units reads without a fault otherwise.
  void check_counts() const {
    for (std::size_t i = 0; i < out_.perceptions.size(); ++i) {
      if (out_.perceptions[i].channels.size() != channel_counts_[i])
        fail("the number of a perception's channels is not the stated one");
    }
    for (const auto& [band, count] : effect_counts_) {
      const auto found = effects_.find(band);
      if ((found == effects_.end() ? 0 : found->second.size()) != count)
        fail("the number of a band's effects is not the stated one");
    }
  }

  [[noreturn]] void fail(const std::string& message) const { throw Error(name_ + ": " + message); }

  void require_none(std::uint32_t value, const char* what) const {
    if (value != 0) fail(std::string(what) + " cannot be read");
  }

  std::string_view take_bytes(std::string_view& from, std::size_t size, const char* what) const {
    if (size > from.size()) fail(std::string(what) + " ends early");
    const std::string_view out = from.substr(0, size);
    from.remove_prefix(size);
    return out;
  }

  void read_unit() {
    BitReader header(take_bytes(bytes_, kHmpgUnitHeader_bytes, "a unit's header"), name_ + ": a unit's header");
    const std::uint32_t type = header.take(6);
    if (type > 3) fail("a unit of type " + std::to_string(type));
    if (header.take(2) > 1) fail("a unit whose sync is neither 0 nor 1");
    header.take(4);
    const std::int64_t duration = header.take(24);
    const std::string_view packets = take_bytes(bytes_, header.take(32), "a unit");
    unit_ = static_cast<HmpgUnit>(type);
    if (unit_ != HmpgUnit::kInitialization && !metadata_) fail("the first unit is not an initialization unit");
    if (unit_ == HmpgUnit::kInitialization) {
      read_initialization(packets);
    } else {
      read_packets(packets);
    }
    time_ += duration;
  }

  // Metadata are read once; a repeated unit may differ in its time alone.
  void read_initialization(std::string_view packets) {
    std::string_view rest = packets;
    if (rest.size() < kHmpgPacketHeader_bytes) fail("an initialization unit without packets");
    BitReader header(rest.substr(0, kHmpgPacketHeader_bytes), name_);
    if (header.take(6) != static_cast<std::uint32_t>(HmpgPacket::kInitializationTiming))
      fail("an initialization unit that does not begin with its timing");
    const std::size_t timing = std::min<std::size_t>(kHmpgPacketHeader_bytes + header.take(17), rest.size());
    rest.remove_prefix(timing);
    if (metadata_ && *metadata_ != rest) fail("a second initialization unit has other metadata");
    read_packets(metadata_ ? packets.substr(0, timing) : packets);
    metadata_ = rest;
  }

  void read_packets(std::string_view packets) {
    while (!packets.empty()) {
      BitReader header(take_bytes(packets, kHmpgPacketHeader_bytes, "a packet's header"), name_);
      const std::uint32_t type = header.take(6);
      const std::string_view payload = take_bytes(packets, header.take(17), "a packet");
      read_packet(type, BitReader(payload, name_ + ": a packet of type " + std::to_string(type)));
    }
  }

  void read_packet(std::uint32_t type, BitReader in) {
    const bool data_unit = unit_ == HmpgUnit::kSpatial || unit_ == HmpgUnit::kTemporal;
    const auto packet = static_cast<HmpgPacket>(type);
    const bool belongs =
        packet == HmpgPacket::kTiming || (packet == HmpgPacket::kData ? data_unit : unit_ == HmpgUnit::kInitialization);
    if (!belongs) fail("a packet of type " + std::to_string(type) + " in a unit that cannot hold it");
    switch (packet) {
      case HmpgPacket::kTiming:
        time_ = in.take(32);
        break;
      case HmpgPacket::kExperience:
        read_experience(in);
        break;
      case HmpgPacket::kPerception:
        read_perception(in);
        break;
      case HmpgPacket::kChannel:
        read_channel(in);
        break;
      case HmpgPacket::kBand:
        read_band(in);
        break;
      case HmpgPacket::kData:
        read_data(in);
        break;
      case HmpgPacket::kInitializationTiming:
        time_ = in.take(32);
        read_timescale(in.take(32));
        in.take(24), in.take(24), in.take(1);
        break;
      default:
        fail("a packet of type " + std::to_string(type) + " cannot be read");
    }
  }

  void read_timescale(std::uint32_t timescale) {
    if (timescale < 1 || timescale > static_cast<std::uint32_t>(kHighestHapticTimescale))
      fail("a timescale of " + std::to_string(timescale) + "; 1 to " + std::to_string(kHighestHapticTimescale));
    out_.timescale = static_cast<int>(timescale);
  }

  void read_experience(BitReader& in) {
    in.take_text(in.take(8));  // version
    in.take_text(in.take(8));  // profile
    in.take(8);
    in.take_text(in.take(8));  // date
    out_.description = in.take_text(in.take(8));
    perception_count_ = in.take(8);
    require_none(in.take(8), "avatars");
  }

  void read_perception(BitReader& in) {
    const std::uint32_t id = in.take(8);
    if (!perceptions_.emplace(id, out_.perceptions.size()).second) fail("a perception's id is given twice");
    HapticPerception perception;
    in.take(8);
    perception.description = in.take_text(in.take(8));
    const auto modality = static_cast<int>(in.take(8));
    const auto known = std::find(kHmpgModalities.begin(), kHmpgModalities.end(), modality);
    if (known == kHmpgModalities.end()) fail("perceptions of modality " + std::to_string(modality) + " cannot be read");
    perception.modality = static_cast<HapticModality>(known - kHmpgModalities.begin());
    require_none(in.take(8), "avatars");
    require_none(in.take(16), "effect libraries");
    require_none(in.take(1), "semantics");
    perception.unit_exponent = static_cast<int>(in.take_signed(8));
    perception.perception_unit_exponent = static_cast<int>(in.take_signed(8));
    require_none(in.take(8), "reference devices");
    channel_counts_.push_back(in.take(16));
    out_.perceptions.push_back(std::move(perception));
  }

  void read_channel(BitReader& in) {
    const std::uint32_t id = in.take(16);
    const std::uint32_t perception_id = in.take(8);
    const auto perception = perceptions_.find(perception_id);
    if (perception == perceptions_.end()) fail("a channel of a perception that is not given");
    auto& channels = out_.perceptions[perception->second].channels;
    if (!channels_.emplace(id, Place{perception->second, channels.size(), perception_id, id}).second)
      fail("a channel's id is given twice");
    HapticChannel channel;
    in.take(8);
    channel.description = in.take_text(in.take(8));
    if (in.take(8) != static_cast<std::uint32_t>(kHmpgNoReferenceDevice)) fail("reference devices cannot be read");
    channel.gain = hmpg_gain(in.take(32));
    // The nearest code to 1; a writer that rounds in float32 is off by less than this.
    if (std::abs(hmpg_weight(in.take(32)) - 1.0) > 1e-2) fail("mixing weights other than 1 cannot be read");
    const std::uint32_t optional = in.take(8);
    if (optional > 1) fail("directions and body part targets cannot be read");
    if (optional == 1) require_none(in.take(32), "body part masks");
    require_none(in.take(32), "sampling frequencies");
    require_none(in.take(16), "vertices");
    if (in.take(8) != 1) fail("a channel of more or less than one band cannot be read");
    channels.push_back(std::move(channel));
  }

  void read_band(BitReader& in) {
    const std::uint32_t id = in.take(8);
    const std::uint32_t perception_id = in.take(8);
    const auto channel = channels_.find(in.take(16));
    if (channel == channels_.end() || channel->second.perception_id != perception_id)
      fail("a band of a channel that is not given");
    if (!bands_.emplace(id, channel->second).second) fail("a band's id is given twice");
    in.take(8);
    const std::uint32_t type = in.take(3);
    if (type != static_cast<std::uint32_t>(kHmpgCurveBand)) fail("bands other than curves cannot be read");
    if (in.take(4) != static_cast<std::uint32_t>(kHmpgLinearCurve)) fail("curves that are not linear cannot be read");
    require_none(in.take(16), "lower frequency limits");
    channel_at(channel->second).highest_frequency = static_cast<int>(in.take(16));
    effect_counts_[id] = in.take(16);
  }

  HapticChannel& channel_at(const Place& place) { return out_.perceptions[place.perception].channels[place.channel]; }

  void read_data(BitReader& in) {
    in.take(1);
    const std::uint32_t perception_id = in.take(8);
    const std::uint32_t channel_id = in.take(16);
    const std::uint32_t band_id = in.take(8);
    const auto band = bands_.find(band_id);
    if (band == bands_.end() || band->second.perception_id != perception_id || band->second.channel_id != channel_id)
      fail("data of a band that is not given");
    const bool temporal = out_.perceptions[band->second.perception].modality == HapticModality::kVibrotactile;
    if (temporal != (unit_ == HmpgUnit::kTemporal)) fail("data in a unit of the other kind, spatial or temporal");
    const std::uint32_t effects = in.take(16);
    for (std::uint32_t i = 0; i < effects; ++i) {
      effects_[band_id].insert(in.take(16));  // what continues in another unit has the same id
      if (in.take(2) != static_cast<std::uint32_t>(kHmpgBasisEffect)) fail("effects other than Basis cannot be read");
      const std::int64_t begin = in.take_signed(25) + (temporal ? time_ : 0);
      require_none(in.take(1), "semantics");
      const std::uint32_t keyframes = in.take(16);
      for (std::uint32_t k = 0; k < keyframes; ++k) {
        const double amplitude = hmpg_amplitude(in.take(8));
        add_keyframe(channel_at(band->second), {begin + static_cast<std::int64_t>(in.take(16)), amplitude});
      }
    }
  }

  // The last keyframe of an effect and the first of the next are one.
  void add_keyframe(HapticChannel& channel, const HapticKeyframe& keyframe) const {
    if (!channel.keyframes.empty() && channel.keyframes.back().position == keyframe.position) {
      if (channel.keyframes.back().amplitude == keyframe.amplitude) return;
      fail("the channel '" + printable(channel.description, 80) + "' has two amplitudes at " +
           std::to_string(keyframe.position));
    }
    channel.keyframes.push_back(keyframe);
  }

  std::string_view bytes_;
  std::string name_;
  HapticExperience out_;
  HmpgUnit unit_ = HmpgUnit::kInitialization;
  std::int64_t time_ = 0;
  std::size_t perception_count_ = 0;
  std::optional<std::string_view> metadata_;  // of the initialization unit, without its timing
  std::map<std::uint32_t, std::size_t> perceptions_;
  std::map<std::uint32_t, Place> channels_;
  std::map<std::uint32_t, Place> bands_;
  std::vector<std::uint32_t> channel_counts_;                 // as each perception states
  std::map<std::uint32_t, std::uint32_t> effect_counts_;      // as each band states
  std::map<std::uint32_t, std::set<std::uint32_t>> effects_;  // ids, of each band
};

}  // namespace

HapticExperience parse_hmpg(std::string_view bytes, const std::string& name) {
  return HmpgParser(bytes, printable(name, 200)).run();
}

}  // namespace asperity
