import { useEffect, useRef, useState } from "preact/hooks";
import { call } from "../net/connection";
import { Button } from "../ui/Button";
import { Dialog } from "../ui/Dialog";
import { FilePicker } from "../ui/FilePicker";
import { Select } from "../ui/Select";
import { TextField } from "../ui/TextField";
import { Warning } from "../ui/Warning";
import { NewestWins } from "../pages/process/newestWins";
import { columnsSetting, columnsText, recordingName, withMeaning, type ImportPlan, type PlanFile } from "./importPlan";
import { PlanTable } from "./PlanTable";

const kPatience_ms = 1500;
const kRoles = [
  { role: "pose", label: "Poses", none: undefined, hint: "Positions and rotations by a tracker." },
  { role: "imu", label: "Accelerometer", none: "File of the poses", hint: "It may contain the gyroscope as well." },
  { role: "gyro", label: "Gyroscope", none: "File of the accelerometer", hint: "" },
  { role: "force", label: "Force", none: "None, or in one of the other files", hint: "" },
] as const;
const kUp = [{ value: "", label: "found by gravity" }, "x", "y", "z", "-x", "-y", "-z"];
const kEuler = [{ value: "", label: "found by the gyroscope" }, "xyz", "xzy", "yxz", "yzx", "zxy", "zyx"];

type Files = Record<string, string>;
type Settings = Record<string, string>;

/** Tables of another program as a recording: files, columns and units, what the checks find, a name. */
export function ImportDialog({ first, onClose, onDone }: { first: string; onClose(): void; onDone(recording: string): void }) {
  const [files, setFiles] = useState<Files>({ pose: first, imu: "", gyro: "", force: "" });
  const [settings, setSettings] = useState<Settings>({});
  const [name, setName] = useState(first ? recordingName(first) : "");
  const [plan, fault] = usePlan(files, settings);
  const set = (path: string, value: string) => setSettings(({ [path]: _old, ...rest }) => (value === "" ? rest : { ...rest, [path]: value }));
  const choose = (role: string, file: string) => {
    setFiles({ ...files, [role]: file });
    // What was stated of other columns means nothing in another file.
    setSettings((old) => Object.fromEntries(Object.entries(old).filter(([path]) => path !== `mapping.${role}.columns`)));
    if (role === "pose" && file && !name) setName(recordingName(file));
  };
  const change = (file: PlanFile, number: number, by: Parameters<typeof withMeaning>[2]) => set(columnsSetting[file.role]!, columnsText(withMeaning(file.map, number, by)));
  const ready = plan !== null && plan.fault === "" && plan.doubts.length === 0 && name !== "";
  return (
    <Dialog
      open
      wide
      title="Import tables"
      onClose={onClose}
      actions={
        <>
          <TextField label="Name of the recording" value={name} onChange={setName} testId="import-name" />
          <Button
            kind="primary"
            disabled={!ready}
            hint={ready ? undefined : "Correct every fault named above first."}
            testId="import-write"
            onClick={async () => onDone((await call<{ recording: string }>("import.write", { files, settings, name })).recording)}
          >
            Import
          </Button>
        </>
      }
    >
      <div class="import-files">
        {kRoles.map(({ role, label, none, hint }) => (
          <FilePicker key={role} label={label} kinds={["table"]} value={files[role]!} none={none} hint={hint} onChange={(file) => choose(role, file)} testId={`import-${role}`} />
        ))}
      </div>
      <div class="import-settings">
        <Select label="Upward axis" value={settings["mapping.up"] ?? ""} options={kUp} onChange={(value) => set("mapping.up", value)} testId="import-up" />
        <Select label="Order of Euler angles" value={settings["mapping.euler"] ?? ""} options={kEuler} onChange={(value) => set("mapping.euler", value)} />
        <Select
          label="Clocks of the files"
          value={settings["mapping.clocks"] ?? ""}
          options={[{ value: "", label: "one, if their times overlap" }, "one", "separate"]}
          onChange={(value) => set("mapping.clocks", value)}
        />
        <TextField label="Sensor axes in the body frame" value={settings["mapping.imu_axes"] ?? ""} placeholder="x,y,z" onChange={(value) => set("mapping.imu_axes", value)} />
      </div>
      {fault && <p class="empty" role="alert">{fault}</p>}
      {plan?.files.map((file) => <PlanTable key={file.role} file={file} onChange={(number, by) => change(file, number, by)} />)}
      {plan && (
        <section aria-label="Checks" data-testid="import-checks" aria-live="polite">
          {plan.fault && <p class="import-fault" role="alert">{plan.fault}</p>}
          {plan.doubts.map((doubt) => (
            <Warning key={doubt} words={doubt} />
          ))}
          {plan.checks && <pre class="import-found">{plan.checks}</pre>}
        </section>
      )}
    </Dialog>
  );
}

/** What the server reads the files as; the newest question wins. */
function usePlan(files: Files, settings: Settings): [ImportPlan | null, string] {
  const [plan, setPlan] = useState<ImportPlan | null>(null);
  const [fault, setFault] = useState("");
  const queue = useRef(new NewestWins(kPatience_ms));
  useEffect(() => {
    if (!files.pose) {
      setPlan(null);
      return setFault("");
    }
    queue.current.ask(async (isNewest) => {
      try {
        const found = await call<ImportPlan>("import.look", { files, settings });
        if (!isNewest()) return;
        setPlan(found);
        setFault("");
      } catch (error) {
        if (!isNewest() || (error as Error).message === "cancelled") return;
        setFault((error as Error).message);
      }
    });
  }, [files, settings]);
  return [plan, fault];
}
