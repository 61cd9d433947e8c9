import { VerdictList } from "../../measured/VerdictList";
import { call, link } from "../../net/connection";
import { leaseIsMine } from "../../state/lease";
import { Button } from "../../ui/Button";
import { Figure } from "../../ui/Figure";
import { Figures } from "../../ui/Figures";
import { Lamp } from "../../ui/Lamp";
import { fixed, withUnit } from "../../ui/format";
import { Panel } from "../../ui/Panel";
import { say } from "../../ui/toast";
import { causeWords, feelState, feelStatus, forceWords, length3 } from "./feelStore";

/** What is rendered now, and what limits it. */
export function TouchPanel() {
  const state = feelState.value;
  const status = feelStatus.value;
  const { lamp, word } = forceWords(status, state, link.value === "open", leaseIsMine.value);
  return (
    <Panel title="Touch">
      <Lamp state={!state ? "off" : state.touching ? "good" : "off"} word={!state ? "not running" : state.touching ? (state.sticking ? "in contact, sticking" : "in contact") : "in the air"} live testId="feel-contact" />
      <Figures>
        <Figure label="Force on the hand" value={state && floored(length3(state.out), 1e-4)} unit="N" digits={3} testId="feel-out" />
        <Figure label="Texture height" value={state && floored(state.height_m, 1e-9)} factor={1e6} unit="µm" digits={3} testId="feel-height" />
        <Figure label="Speed" value={state && floored(state.speed_mps, 1e-5)} factor={1e3} unit="mm/s" digits={3} />
        <Figure label="Path length on the surface" value={state && floored(state.way_m, 1e-6)} factor={1e3} unit="mm" digits={4} />
      </Figures>
      <h3>Safety</h3>
      <Lamp state={lamp} word={word} label="Force:" testId="feel-watchdog" />
      {state && state.limited.length > 0 && <p class="field-hint">{state.limited.map(causeWords).join(", ")}</p>}
      <Figures>
        <Figure label="Largest force" value={status?.max_force_N} unit="N" digits={3} testId="feel-limit" />
        <Figure label="Soft-start gain" value={state && 100 * state.gain} unit="%" digits={3} testId="feel-gain" />
        <Figure label="Loop" value={state && status ? status.rate_Hz : null} unit="Hz" />
        <Figure label="Delay of ticks, 99th percentile" value={withUnit(fixed(state?.late_p99_us, 1), "µs")} hint="Start of a tick after its due time, over one second" />
        <Figure label="Delay of ticks, maximum" value={withUnit(fixed(state?.late_max_us, 1), "µs")} />
        <Figure label="Skipped ticks" value={state && String(state.skipped)} hint="Due times of the loop without a tick" />
      </Figures>
      {status?.warnings.map((warning) => (
        <p key={warning} class="field-hint">
          {warning}
        </p>
      ))}
      <LastRun />
      <Log />
    </Panel>
  );
}

/** Values below the resolution are shown as zero. */
const floored = (value: number, least: number): number => (Math.abs(value) < least ? 0 : value);

function LastRun() {
  const run = feelStatus.value?.last_run;
  if (!run || feelState.value) return null;
  return (
    <>
      <h3>Last run</h3>
      <p data-testid="feel-last-run">
        {run.duration_s.toFixed(1)} s, then {run.end}. At most {run.figures.force.peak_out_N.toFixed(2)} N on the hand.
      </p>
      {run.verdicts.length > 0 && <VerdictList verdicts={run.verdicts} />}
    </>
  );
}

function Log() {
  const status = feelStatus.value;
  const on = !!status?.log;
  const toggle = async () => {
    const { log } = await call<{ log: string }>("feel.log", { on: !on });
    if (on && log) say(`The log is in ${log}.`);
  };
  return (
    <div class="buttons">
      <Button onClick={toggle} disabled={status?.state !== "running"} pressed={on} hint="One row per tick, as in asperity feel --log" testId="feel-log">
        {on ? `Writing ${status.log}: finish` : "Write a log"}
      </Button>
    </div>
  );
}
