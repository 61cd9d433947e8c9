#include "scenario.h"

typedef enum {
  kBusRefuses,
  kBusWorks,
  kLoopStalls,
  kByteLost,
  kLineLow,
  kLineHigh,
  kLineWorks,
  kSupplyGone,
  kInvalidRows,
  kForceBusRefuses,
  kForceBusWorks,
  kForceStops,
  kDamagedBytes,
  kIdentityRight
} event_kind;

typedef struct {
  uint16_t at_ms;
  uint8_t kind;  // an event_kind
  uint8_t count;
} event;

// The inertial sensor's faults two seconds apart, then the converter's, then the link's.
static const event kFaults[] = {
    {2000, kBusRefuses, 0},       {2100, kBusWorks, 0},                                 // 100 ms
    {4000, kLoopStalls, 60},                                                            // ms; the FIFO holds 32
    {6000, kByteLost, 1},                                                               //
    {8000, kLineLow, 0},          {8300, kLineWorks, 0},                                //
    {11000, kLineHigh, 0},        {11300, kLineWorks, 0},                               //
    {14000, kSupplyGone, 0},                                                            //
    {17000, kInvalidRows, 5},                                                           //
    {18000, kForceBusRefuses, 0}, {18020, kForceBusWorks, 0}, {19000, kForceStops, 0},  //
    {22000, kDamagedBytes, 1},    {22100, kDamagedBytes, 1},  {22200, kDamagedBytes, 1},
};

// Another sensor answers for three seconds.
static const event kAbsent[] = {{3000, kIdentityRight, 0}};

static const event* events_of(world_scenario scenario, uint32_t* count) {
  switch (scenario) {
    case WORLD_FAULTS:
      *count = sizeof kFaults / sizeof kFaults[0];
      return kFaults;
    case WORLD_ABSENT:
      *count = sizeof kAbsent / sizeof kAbsent[0];
      return kAbsent;
    case WORLD_CLEAN:
    default:
      *count = 0;
      return kFaults;
  }
}

void scenario_begin(scenario_state* state, world_scenario scenario, uint64_t now_us, asp_icm42688_model* imu) {
  *state = (scenario_state){scenario, now_us, 0};
  if (scenario == WORLD_ABSENT) {
    imu->identity = 0x48;
  }
}

static void happen(const event* what, asp_icm42688_model* imu, asp_ads1220_model* force, scenario_effects* effects) {
  switch ((event_kind)what->kind) {
    case kBusRefuses:
      imu->bus_works = false;
      break;
    case kBusWorks:
      imu->bus_works = true;
      break;
    case kLoopStalls:
      effects->stall_us += what->count * 1000u;
      break;
    case kByteLost:
      imu->lose_bytes = what->count;
      break;
    case kLineLow:
      imu->line = ASP_MODEL_LINE_LOW;
      break;
    case kLineHigh:
      imu->line = ASP_MODEL_LINE_HIGH;
      break;
    case kLineWorks:
      imu->line = ASP_MODEL_LINE_WORKS;
      break;
    case kSupplyGone:
      asp_icm42688_model_power_cycle(imu);
      break;
    case kInvalidRows:
      imu->invalid_from = imu->rows_made;
      imu->invalid_to = imu->rows_made + what->count;
      break;
    case kForceBusRefuses:
      force->bus_works = false;
      break;
    case kForceBusWorks:
      force->bus_works = true;
      break;
    case kForceStops:
      force->converting = false;
      break;
    case kDamagedBytes:
      effects->damaged_bytes += what->count;
      break;
    case kIdentityRight:
      imu->identity = 0x47;
      break;
  }
}

scenario_effects scenario_advance(scenario_state* state, uint64_t now_us, asp_icm42688_model* imu,
                                  asp_ads1220_model* force) {
  scenario_effects effects = {0};
  uint32_t count = 0;
  const event* events = events_of(state->scenario, &count);
  while (state->next < count && now_us - state->began_us >= events[state->next].at_ms * UINT64_C(1000)) {
    happen(&events[state->next], imu, force, &effects);
    ++state->next;
  }
  return effects;
}
