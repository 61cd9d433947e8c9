import { useEffect, useState } from "preact/hooks";
import { call, link } from "../../net/connection";
import { edit } from "../../state/document";
import { giveForce, leaseIsMine, leaseIsOthers } from "../../state/lease";
import { attempt, Button } from "../../ui/Button";
import { FilePicker } from "../../ui/FilePicker";
import { Lamp } from "../../ui/Lamp";
import { Panel } from "../../ui/Panel";
import { Select } from "../../ui/Select";
import { Slider } from "../../ui/Slider";
import { TextField } from "../../ui/TextField";
import { feelSection } from "./feelChoices";
import { commandsRun, feelStatus, startFeeling, stopFeeling, takeRun } from "./feelStore";

interface Device {
  name: string;
  title: string;
  available: boolean;
  words: string;
  driven: boolean;
  felt: boolean;
}

/** Which device, start and stop, and who has the force. */
export function DevicePanel({ depth_m, deepest_m, onDepth }: { depth_m: number; deepest_m: number; onDepth(depth_m: number): void }) {
  const [devices, setDevices] = useState<Device[]>([]);
  useEffect(() => {
    if (link.value === "open") void attempt(async () => setDevices(await call<Device[]>("feel.devices")));
  }, [link.value]);
  const chosen = feelSection.value ?? {};
  const status = feelStatus.value;
  const name = chosen.device ?? "mouse";
  const device = devices.find((one) => one.name === name);
  const idle = !status || status.state === "idle";
  const nothing = !chosen.scene && !chosen.height_maps?.length;
  return (
    <Panel title="Device">
      <Select
        label="Device"
        value={name}
        options={devices.map((one) => ({ value: one.name, label: one.available ? one.title : `${one.title} (not set up)` }))}
        hint={device?.words}
        disabled={!idle}
        wide
        onChange={(next) => attempt(() => edit("/feel/device", next, `device ${next}`))}
        testId="feel-device"
      />
      {device?.driven && <ReplayChoice disabled={!idle} />}
      {name === "mouse" && (
        <Slider
          label="Press depth"
          value={depth_m}
          low={0}
          high={deepest_m}
          step={1e-4}
          factor={1e3}
          unit="mm"
          hint="Hold the left button or Shift to press; use the wheel to change the depth. Keys in the view: Page Down presses, Page Up releases, arrows move."
          onInput={onDepth}
          testId="feel-depth"
        />
      )}
      <div class="buttons">
        {idle ? (
          <Button kind="primary" onClick={startFeeling} disabled={nothing} hint={nothing ? "Choose a scene first" : undefined} testId="feel-start">
            Start
          </Button>
        ) : (
          <Button kind="danger" onClick={stopFeeling} testId="feel-stop">
            Stop
          </Button>
        )}
        {status?.may_command_forces &&
          (leaseIsMine.value && (idle || commandsRun()) ? (
            <Button onClick={giveForce} hint="The force ramps to zero, and another window can take it" testId="feel-give">
              Release the force
            </Button>
          ) : (
            <Button onClick={takeRun} disabled={leaseIsOthers.value} testId="feel-take">
              Take the force
            </Button>
          ))}
      </div>
      <Lease />
    </Panel>
  );
}

function Lease() {
  if (feelStatus.value && !feelStatus.value.may_command_forces) {
    return <p class="field-hint">This studio does not command forces, because other machines can reach it. Start it with --remote-force to allow forces.</p>;
  }
  if (leaseIsMine.value) return <Lamp state="good" word="this window has the force" live testId="feel-lease" />;
  if (leaseIsOthers.value) return <Lamp state="warn" word="another window has the force" live testId="feel-lease" />;
  return <Lamp state="off" word="no window has the force" live testId="feel-lease" />;
}

/** What moves the point where nobody does. */
function ReplayChoice({ disabled }: { disabled: boolean }) {
  const chosen = feelSection.value ?? {};
  const replay = chosen.replay ?? "";
  const set = (name: string) => attempt(() => edit("/feel/replay", name, name ? `replay ${name}` : "no replay"));
  if (chosen.device === "sim") return null;
  return (
    <>
      <FilePicker label="Recording" kinds={["recording"]} value={replay.endsWith(".csv") ? "" : replay} none="None" disabled={disabled} onChange={set} />
      <TextField label="Or a table" value={replay.endsWith(".csv") ? replay : ""} hint="trajectory.csv in the folder, with px_m,py_m,pz_m" disabled={disabled} onChange={set} />
    </>
  );
}
