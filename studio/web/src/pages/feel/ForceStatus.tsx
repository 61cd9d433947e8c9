import { useEffect } from "preact/hooks";
import { link } from "../../net/connection";
import { leaseIsMine } from "../../state/lease";
import { attempt, Button } from "../../ui/Button";
import { fixed } from "../../ui/format";
import { useKeys } from "../../ui/keys";
import { Lamp } from "../../ui/Lamp";
import { feelState, feelStatus, followFeel, forceWords, isActive, length3, stopFeeling } from "./feelStore";
import "./forceStatus.css";

/** The state of the forces and their stop, in the header of all pages. Escape stops, also from within a dialog. */
export function ForceStatus() {
  useEffect(followFeel, []);
  useEffect(() => {
    const listen = (event: KeyboardEvent) => {
      if (event.key === "Escape" && isActive(feelStatus.value)) void attempt(stopFeeling);
    };
    window.addEventListener("keydown", listen, { capture: true });
    return () => window.removeEventListener("keydown", listen, { capture: true });
  }, []);
  useKeys([{ key: "escape", label: "stop the force", run: () => undefined, always: true }], "Forces");

  const status = feelStatus.value;
  const state = feelState.value;
  const active = isActive(status);
  const { lamp, word } = forceWords(status, state, link.value === "open", leaseIsMine.value);
  const out_N = state ? length3(state.out) : 0;
  return (
    <div class="force" role="group" aria-label="Force">
      <Lamp state={lamp} word={word} label="Force:" live testId="force-watchdog" />
      <span class="force-now" data-testid="force-now">
        <span class="visually-hidden">on the hand </span>
        {fixed(out_N, 2)} <span class="force-words">of at most</span>
        <span class="force-slash" aria-hidden="true">/</span> {status ? fixed(status.max_force_N, 1) : "–"} N
      </span>
      <Button kind="danger" onClick={stopFeeling} disabled={!active || link.value !== "open"} hint="Ramps the force to zero and ends the run (Esc)" testId="force-stop">
        Stop
      </Button>
    </div>
  );
}
