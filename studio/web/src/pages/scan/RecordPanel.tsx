import { useState } from "preact/hooks";
import { Button } from "../../ui/Button";
import { Icon } from "../../ui/Icon";
import { Lamp } from "../../ui/Lamp";
import { Panel } from "../../ui/Panel";
import { TextField } from "../../ui/TextField";
import { Toggle } from "../../ui/Toggle";
import { fixed, withUnit } from "../../ui/format";
import { discard, rescan, restore, segment, start, stop, toggleAuto } from "./commands";
import { abilities, discardedWords, recordWords } from "./scanState";
import { scan } from "./settings";
import { state } from "./stream";

/** Whether it records, and the buttons for that. */
export function RecordPanel() {
  const now = state.value;
  const words = recordWords(now);
  const can = abilities(now);
  const [name, setName] = useState("");
  return (
    <Panel title="Record" testId="scan-record">
      <div class={`scan-big scan-big-${now?.recorder?.storing ? "on" : "off"}`}>
        <Lamp state={words.lamp} word={words.word} live testId="scan-record-state" />
        <span class="scan-time" data-testid="scan-recorded">
          {withUnit(fixed(now?.recorder?.recorded_s ?? null, 1), "s")}
        </span>
      </div>
      <div class="scan-buttons">
        <Button kind="primary" onClick={start} disabled={!can.start} hint="Space" testId="scan-start">
          <Icon name="record" /> Start
        </Button>
        <Button onClick={stop} disabled={!can.stop} hint="Space" testId="scan-stop">
          <Icon name="stop" /> Stop
        </Button>
        <Button onClick={() => segment(name)} disabled={!can.segment} hint="S: ends this segment and starts the next" testId="scan-segment">
          <Icon name="plus" /> Segment
        </Button>
        <Button onClick={rescan} disabled={!can.rescan} hint="R: discards the last segment and records it again" testId="scan-rescan">
          <Icon name="reset" /> Rescan
        </Button>
        <Button kind="danger" onClick={discard} disabled={!can.discard} hint="D: removes the last segment" testId="scan-discard">
          <Icon name="trash" /> Discard
        </Button>
        <Button onClick={restore} disabled={!can.restore} hint="U: restores the segment that was discarded last" testId="scan-restore">
          <Icon name="undo" /> Undo discard
        </Button>
      </div>
      <p class="field-hint" role="status" data-testid="scan-discarded">{discardedWords(now)}</p>
      <Toggle label="Auto: record while the probe touches (A)" on={scan.value.auto} onChange={toggleAuto} testId="scan-auto" />
      {can.segment && <TextField label="Next segment's name" value={name} onChange={setName} placeholder="segment_…" />}
    </Panel>
  );
}
