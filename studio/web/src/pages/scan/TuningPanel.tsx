import { Button } from "../../ui/Button";
import { type ConfigField, ConfigForm } from "../../ui/ConfigForm";
import { Dialog } from "../../ui/Dialog";
import { Panel } from "../../ui/Panel";
import { Select } from "../../ui/Select";
import { Slider } from "../../ui/Slider";
import { Toggle } from "../../ui/Toggle";
import { complain } from "../../ui/toast";
import { useState } from "preact/hooks";
import { cutoffWords } from "../process/processing";
import { setSettings, waitsForOpening } from "./settings";

/** What is tuned while one looks at the profile (thesis §7.2), and the link to all settings. */
export function TuningPanel({ fields }: { fields: readonly ConfigField[] }) {
  const [all, setAll] = useState(false);
  const value = (path: string) => fields.find((field) => field.path === path)?.value;
  const number = (path: string) => Number(value(path) ?? 0);
  const thesis = value("process.method") === "thesis";
  const set = (changes: Record<string, string | null>, label: string, gesture = "") => setSettings(changes, label, gesture).catch(complain);
  return (
    <Panel title="Tune" collapsible testId="scan-tune">
      <Slider label="High-pass cut-off" low={0} high={2} step={0.01} unit="cycles/mm" value={number("process.profile.cutoff_cycles_per_mm")} testId="scan-cutoff"
        hint={cutoffWords(number("process.profile.cutoff_cycles_per_mm"))}
        onInput={(cutoff, gesture) =>
          set({ "process.profile.cutoff_cycles_per_mm": String(cutoff), "process.thesis.profile.cutoff_cycles_per_mm": String(cutoff) }, "change the cut-off", gesture)} />
      <Slider label="Velocity threshold" low={0} high={0.05} step={0.0005} factor={1e3} unit="mm/s" value={number("live.min_speed_mps")} testId="scan-min-speed"
        onInput={(speed, gesture) => set({ "live.min_speed_mps": String(speed), "process.thesis.profile.min_speed_mps": String(speed) }, "change the velocity threshold", gesture)} />
      <Toggle label="Force compensation" on={value("live.scale_by_force") === true} testId="scan-scale"
        hint={thesis ? undefined : "For the live profile. The refined profile uses it only with the method of the thesis."}
        onChange={(on) => set({ "live.scale_by_force": String(on), "process.thesis.profile.scale_by_force": String(on) }, on ? "compensate the force" : "do not compensate the force")} />
      <Slider label="Shortest wavelength" low={0.1} high={10} logarithmic unit="mm" value={Math.max(0.1, number("hints.finest_wavelength_mm"))} testId="scan-finest"
        onInput={(wave, gesture) => set({ "hints.finest_wavelength_mm": String(wave) }, "change the shortest wavelength", gesture)} />
      <Select label="Refined by" value={String(value("process.method") ?? "fused")} testId="scan-method"
        options={[{ value: "fused", label: "fused estimate" }, { value: "thesis", label: "method of the thesis" }]}
        onChange={(method) => set({ "process.method": method }, "change the method")} />
      <Button kind="quiet" onClick={() => setAll(true)} testId="scan-all-settings">
        All settings …
      </Button>
      <Dialog title="All settings of the scan" open={all} onClose={() => setAll(false)}>
        <p class="field-hint">Settings of process, live and hints take effect at once, those of recorder, track and bench when the source is opened again.</p>
        <ConfigForm fields={fields}
          onChange={(path, text) => set({ [path]: text }, waitsForOpening(path) ? `change ${path} for the next opening` : `change ${path}`)} />
      </Dialog>
    </Panel>
  );
}
