#pragma once

#include <string>

#include "asperity/scene/haptic_experience.h"

namespace asperity {

// An experience as HMPG, the binary distribution format of ISO/IEC 23090-31 (MIHS units): one initialization unit with
// the metadata, one spatial unit with textures, stiffness and friction, and a temporal unit for each effect of a
// vibration. Bits are in the order of the file from the highest of each byte on; packets are padded with zeros.
//
//   unit     type 6, sync 2 (0: independent), layer 4 (0), duration 24 (ticks), length 32 (bytes behind it), reserved 4
//   packet   type 6, length 17 (bytes behind it), reserved 1
//   timing       time 32 (0), timescale 32, nominal duration 24, duration deviation 24 (ticks), overlapping 1 (0)
//   experience   version, profile, level 8, date, description, perceptions 8, avatars 8 (0); texts as length 8, bytes
//   perception   id 8, priority 8 (0), description, modality 8, avatar 8 (0), effects of the library 16 (0), semantic
//                scheme 1 (0), unit exponent 8, perception unit exponent 8, reference devices 8 (0), channels 16
//   channel      id 16, perception 8, priority 8 (0), description, reference device 8 (255: none), gain 32, mixing
//                weight 32, optional fields 8 (1), body part mask 32 (0), sampling frequency 32 (0), vertices 16 (0),
//                bands 8 (1)
//   band         id 8, perception 8, channel 16, priority 8 (0), type 3 (Curve), curve 4 (Linear), lower and upper
//                frequency 16 each, effects 16
//   data         dependent 1 (0), perception 8, channel 16, band 8, effects 16; of each effect: id 16, type 2 (Basis),
//                position 25 (signed, behind the unit's begin), semantic 1 (0), keyframes 16; of each keyframe:
//                amplitude 8, position 16 (behind the effect's)
//
// Numbers of n bits are a range in 2^n − 1 steps: amplitudes −1 to 1 (error at most 1/255 of the gain; 0 is not one of
// the codes), gains −10000 to 10000, weights 0 to 10000. Each perception gets the unit exponent, a multiple of 3 from
// its own on, at which its greatest gain is between 10 and 10000, so that a gain's error is below 3e-7 of it.
//
// The layout is what IOStream of the reference software (MPEGGroup/HapticReferenceSoftware) reads at 8ec8b57f; ids are
// unique in the experience, as its reader needs them. The numbers of the modalities (6, 10, 12, 13) are those of the
// later 1bc5bef5. The ranges that IOCompatibility checks at 199fd094 are these. The standard's text was not read.
// Frequencies above 65535 become 65535. Throws Error as format_hjif, and for a position above 16777215, more than 255
// perceptions, 256 channels, 65536 effects or 4 GiB, a gain above 1e130, or vibrations whose effects overlap in time.
std::string format_hmpg(const HapticExperience& experience);

// The greatest difference of a keyframe's value from the one that format_hmpg writes, in the values' SI unit.
double hmpg_value_error(const HapticPerception& perception, const HapticChannel& channel);

}  // namespace asperity
