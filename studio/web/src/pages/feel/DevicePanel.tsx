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
          label="How deep a press goes"
          value={depth_m}
          low={0}
          high={deepest_m}
          step={1e-4}
          factor={1e3}
          unit="mm"
          hint="Hold the left button or Shift to press; the wheel changes this meanwhile. By keys, in the view: Page Down presses, Page Up lifts, arrows move."
          onInput={onDepth}
          testId="feel-depth"
        />
      )}
      <div class="buttons">
        {idle ? (
          <Button kind="primary" onClick={startFeeling} disabled={nothing} hint={nothing ? "Choose what is to be felt first" : undefined} testId="feel-start">
            Start
          </Button>
        ) : (
          <Button kind="danger" onClick={stopFeeling} testId="feel-stop">
            Stop
          </Button>
        )}
        {status?.may_command_forces &&
          (leaseIsMine.value && (idle || commandsRun()) ? (
            <Button onClick={giveForce} hint="The force ramps to zero; another window may take it" testId="feel-give">
              Let the force go
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
    return <p class="field-hint">Forces are not commanded from here: the studio listens to other machines. Start it with --remote-force to change that.</p>;
  }
  if (leaseIsMine.value) return <Lamp state="good" word="this window has the force" live testId="feel-lease" />;
  if (leaseIsOthers.value) return <Lamp state="warn" word="another window has the force" live testId="feel-lease" />;
  return <Lamp state="off" word="nobody has the force" live testId="feel-lease" />;
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
