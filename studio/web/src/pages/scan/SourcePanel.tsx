import { useEffect, useState } from "preact/hooks";
import { call } from "../../net/connection";
import { edit } from "../../state/document";
import { Button } from "../../ui/Button";
import { ConfigControl } from "../../ui/ConfigControl";
import type { ConfigField } from "../../ui/ConfigForm";
import { fieldName } from "../../ui/configFields";
import { FilePicker } from "../../ui/FilePicker";
import { NumberField } from "../../ui/NumberField";
import { Panel } from "../../ui/Panel";
import { Select } from "../../ui/Select";
import { TextField } from "../../ui/TextField";
import { Toggle } from "../../ui/Toggle";
import { complain } from "../../ui/toast";
import { close, open } from "./commands";
import { scan, setSettings, type ScanSection } from "./settings";
import { state } from "./stream";

const SOURCES = [
  { value: "bench", label: "The virtual bench" },
  { value: "hardware", label: "Probe and camera" },
  { value: "replay", label: "A recording, replayed" },
];

const set = (path: string, value: unknown, label: string) => edit(`/scan/${path}`, value, label).catch(complain);

/** Where the rows come from. */
export function SourcePanel({ fields }: { fields: readonly ConfigField[] }) {
  const now = state.value;
  const isOpen = now?.open ?? false;
  const busy = now?.opening ?? false;
  const chosen = scan.value;
  return (
    <Panel title="Source" collapsible testId="scan-source-panel">
      <Select label="Source of the samples" wide value={chosen.source} options={SOURCES} disabled={isOpen || busy} testId="scan-source"
        onChange={(source) => set("source", source, "choose the source")} />
      {isOpen ? (
        <Button onClick={close} disabled={busy} testId="scan-close">
          Finish the recording and close
        </Button>
      ) : (
        <Button kind="primary" onClick={open} disabled={busy} testId="scan-open">
          {busy ? "Opening …" : "Open"}
        </Button>
      )}
      <fieldset class="scan-fields" disabled={isOpen || busy}>
        <legend class="visually-hidden">Settings of the source</legend>
        {chosen.source === "bench" && <Bench fields={fields} />}
        {chosen.source === "hardware" && <Hardware hardware={chosen.hardware} />}
        {chosen.source === "replay" && (
          <>
            <FilePicker label="Recording" kinds={["recording"]} value={chosen.recording} testId="scan-replayed"
              onChange={(name) => set("recording", name, "choose the recording")} />
            <TextField label="Segment" value={chosen.segment} placeholder="all of it" onChange={(name) => set("segment", name, "choose the segment")} />
          </>
        )}
        <TextField label="Object" value={chosen.object} placeholder="scanned object" testId="scan-object" onChange={(text) => set("object", text, "name the object")} />
        <TextField label="Recording's name" value={chosen.name} hint="If the name exists, a number is added; nothing is overwritten." testId="scan-name"
          onChange={(text) => set("name", text, "name the recording")} />
      </fieldset>
    </Panel>
  );
}

function Bench({ fields }: { fields: readonly ConfigField[] }) {
  return (
    <>
      {fields
        .filter((field) => field.path.startsWith("bench."))
        .map((field) => (
          <BenchControl key={field.path} field={field} onChange={(text) => setSettings({ [field.path]: text }, "change the bench").catch(complain)} />
        ))}
      <p class="field-hint">Press Start: the bench's hand scans once. You can repeat the scan.</p>
    </>
  );
}

/** Lengths and speeds of a bench are of millimetres. */
function BenchControl({ field, onChange }: { field: ConfigField; onChange(text: string): void }) {
  const { label, unit } = fieldName(field.path);
  if (unit !== "m" && unit !== "m/s") return <ConfigControl field={{ ...field, description: undefined }} onChange={onChange} />;
  return (
    <NumberField label={label} value={Number(field.value)} low={field.low ?? undefined} high={field.high ?? undefined} factor={1e3} unit={`m${unit}`}
      testId={`scan-${field.path}`} onChange={(value) => onChange(String(value))} />
  );
}

function Hardware({ hardware }: { hardware: ScanSection["hardware"] }) {
  const [devices, setDevices] = useState<{ serial: string[]; cameras: string[] }>({ serial: [], cameras: [] });
  useEffect(() => void call("scan.sources").then(setDevices).catch(complain), []);
  const text = (key: keyof ScanSection["hardware"], label: string, hint: string, choices: string[] = []) => (
    <TextField label={label} value={String(hardware[key])} wide testId={`scan-hardware-${key}`}
      hint={choices.length ? `${hint} Available: ${choices.join(", ")}.` : hint}
      onChange={(value) => set(`hardware/${key}`, value, `change the ${label.toLowerCase()}`)} />
  );
  return (
    <>
      {text("probe", "Probe", "serial:/dev/ttyUSB0, usb:VID:PID, udp:PORT, or file:CAPTURE in the folder.", devices.serial)}
      <Select label="Protocol" value={hardware.protocol} options={["open", "what"]} onChange={(value) => set("hardware/protocol", value, "change the protocol")} />
      {text("camera", "Camera", "v4l2:/dev/video0?rate=120, or y4m:FIFO in the folder. Empty: no camera.", devices.cameras)}
      {text("poses", "Another tracker", "udp:PORT or pipe:FIFO, instead of a camera.")}
      {text("calibration", "Calibration", "calibration.json in the folder, of probe, camera and tracker.")}
      {text("markers", "Markers", "markers.json in the folder. Empty: those of the calibration.")}
      <Toggle label="Record without a calibration" hint="For calibration recordings; no profile is computed." on={hardware.uncalibrated}
        onChange={(on) => set("hardware/uncalibrated", on, on ? "record without a calibration" : "record with a calibration")} />
      <Select label="World" value={hardware.world} options={[{ value: "camera", label: "the camera's" }, { value: "z_up", label: "z is up" }]}
        onChange={(value) => set("hardware/world", value, "change the world")} />
    </>
  );
}
