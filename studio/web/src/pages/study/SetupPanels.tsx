import { useEffect, useState } from "preact/hooks";
import { call, link } from "../../net/connection";
import { edit } from "../../state/document";
import { attempt, Button } from "../../ui/Button";
import { ConfigForm, type ConfigField } from "../../ui/ConfigForm";
import { Dialog } from "../../ui/Dialog";
import { entries } from "../../ui/entries";
import { FilePicker } from "../../ui/FilePicker";
import { NumberField } from "../../ui/NumberField";
import { Panel } from "../../ui/Panel";
import { Select } from "../../ui/Select";
import { TextField } from "../../ui/TextField";
import { say } from "../../ui/toast";
import { Toggle } from "../../ui/Toggle";
import { settingValue } from "../feel/feelChoices";
import { isCode, isStudyName, lackOf, parameterWords, stimulusName, toggled, trialWords, type Method, type Study } from "./study";
import { setStudy, studySection } from "./studyStore";

const METHODS: { value: Method; label: string }[] = [
  { value: "pairs", label: "Pairs: one of two" },
  { value: "staircase", label: "Staircase: a threshold" },
  { value: "rating", label: "Rating: how real, 1 to 7" },
];
const QUESTIONS: Record<Method, string> = {
  pairs: "Which one is rougher?",
  staircase: "Which one is rougher?",
  rating: "How much does it feel like the real one?",
};

/** Who answers, and the beginning. */
export function BeginPanel() {
  const { study, participant } = studySection.value;
  const [typed, setTyped] = useState("");
  const [asking, setAsking] = useState(false);
  const lack = lackOf(study, participant);
  const begin = async () => {
    setAsking(false);
    await call("study.begin", { consented: study.consent !== "" });
  };
  return (
    <Panel title="Session" testId="study-session-panel">
      <TextField
        label="Participant's code"
        value={participant}
        placeholder="p01"
        hint="Letters, digits, _ and -, not a person's name. The code is part of the log's name."
        error={typed !== "" && !isCode(typed) ? "Only letters, digits, _ and -, at most 40." : ""}
        onInput={setTyped}
        onChange={(code) => attempt(() => edit("/study/participant", code, `participant ${code}`))}
        testId="study-participant"
      />
      <p>{trialWords(study)}</p>
      <Dialog
        title="Consent"
        open={asking}
        onClose={() => setAsking(false)}
        actions={
          <>
            <Button onClick={() => setAsking(false)}>I do not agree</Button>
            <Button kind="primary" onClick={begin} testId="study-agree">
              I agree
            </Button>
          </>
        }
      >
        <p>{study.consent}</p>
      </Dialog>
      <Button kind="primary" onClick={() => (study.consent === "" ? begin() : setAsking(true))} disabled={lack !== ""} hint={lack || undefined} testId="study-begin">
        Begin
      </Button>
      {lack && <p class="field-hint">{lack}</p>}
    </Panel>
  );
}

/** What is asked, and how. */
export function QuestionPanel() {
  const { study } = studySection.value;
  const choose = async (method: Method) => {
    const gesture = `method ${Date.now()}`;
    const usual = study.question === QUESTIONS[study.method];
    await edit("/study/study/method", method, `method ${method}`, gesture);
    if (usual) await edit("/study/study/question", QUESTIONS[method], `the question of ${method}`, gesture);
  };
  return (
    <Panel title="Question">
      <Select label="Method" wide value={study.method} options={METHODS} onChange={(method) => attempt(() => choose(method as Method))} testId="study-method" />
      <TextField label="Question" wide value={study.question} onChange={(text) => attempt(() => setStudy("question", text, "question"))} testId="study-question" />
      {study.method === "rating" && (
        <TextField label="The real object" wide value={study.object} placeholder="sandpaper P80" onChange={(text) => attempt(() => setStudy("object", text, "real object"))} testId="study-object" />
      )}
      <TextField
        label="Consent text"
        wide
        value={study.consent}
        placeholder="none: participants are not asked"
        hint="Participants read it and agree before the first trial; the log states the text."
        onChange={(text) => attempt(() => setStudy("consent", text, "consent text"))}
        testId="study-consent"
      />
      {study.method === "staircase" && <StaircaseChoices study={study} />}
      <NumberField label="Repetitions" integer value={study.repetitions} low={1} high={100} onChange={(value) => attempt(() => setStudy("repetitions", value, "repetitions"))} testId="study-repetitions" />
      <NumberField label="Seed of the order" integer value={study.seed} low={0} high={2 ** 53} onChange={(value) => attempt(() => setStudy("seed", value, "seed"))} />
      <NumberField label="A break after" unit="trials" integer value={study.break_every} low={0} high={1000} hint="0: no breaks" onChange={(value) => attempt(() => setStudy("break_every", value, "breaks"))} testId="study-breaks" />
      <Toggle label="Dates in the log" on={study.dates} onChange={(on) => void attempt(() => setStudy("dates", on, on ? "dates in the log" : "no dates in the log"))} />
    </Panel>
  );
}

function StaircaseChoices({ study }: { study: Study }) {
  const set = (key: string, value: number | string, label: string) => attempt(() => edit(`/study/study/staircase/${key}`, value, label));
  const down = Number(study.staircase.down);
  const weight = Number(study.staircase.up_weight);
  const target = (weight / (1 + weight)) ** (1 / down);
  return (
    <>
      <Select
        label="Meaning of the level"
        wide
        value={String(study.staircase.parameter)}
        options={["height-difference", "height", "stiffness-difference", "friction-difference"].map((value) => ({ value, label: parameterWords(value) }))}
        onChange={(value) => set("parameter", value, `level: ${parameterWords(value)}`)}
        testId="study-parameter"
      />
      <NumberField label="First level" value={Number(study.staircase.start_level)} low={1e-6} high={1000} onChange={(value) => set("start_level", value, "first level")} />
      <NumberField label="Correct answers per step down" integer value={down} low={1} high={5} hint={`Settles at ${(100 * target).toFixed(1)} % correct answers.`} onChange={(value) => set("down", value, "rule of the staircase")} testId="study-down" />
      <NumberField label="Ends after" unit="reversals" integer value={Number(study.staircase.reversals)} low={2} high={100} onChange={(value) => set("reversals", value, "reversals of the staircase")} testId="study-reversals" />
    </>
  );
}

/** Which textures are presented. */
export function StimuliPanel() {
  const { study } = studySection.value;
  const there = entries.value.filter(({ kind }) => kind === "texture" || kind === "image").map(({ name }) => name);
  const names = [...study.stimuli.filter((name) => !there.includes(name)), ...there];
  return (
    <Panel title={`Textures (${study.stimuli.length})`} testId="study-stimuli">
      {names.length === 0 && <p class="empty">No textures or images in the folder. Process a recording first.</p>}
      <ul class="study-stimuli">
        {names.map((name) => (
          <li key={name}>
            <label>
              <input
                type="checkbox"
                checked={study.stimuli.includes(name)}
                onChange={() => void attempt(() => setStudy("stimuli", toggled(study.stimuli, name), `${study.stimuli.includes(name) ? "without" : "with"} ${stimulusName(name)}`))}
              />
              <span>{there.includes(name) ? name : `${name} (not in the folder)`}</span>
            </label>
          </li>
        ))}
      </ul>
    </Panel>
  );
}

interface Device {
  name: string;
  title: string;
  available: boolean;
  words: string;
}

/** What presents them. */
export function PresentationPanel() {
  const { study } = studySection.value;
  const [devices, setDevices] = useState<Device[]>([]);
  const [fields, setFields] = useState<ConfigField[]>([]);
  const [all, setAll] = useState(false);
  useEffect(() => {
    if (link.value === "open") void attempt(async () => setDevices(await call<Device[]>("feel.devices")));
  }, [link.value]);
  useEffect(() => {
    if (all && link.value === "open") void attempt(async () => setFields(await call<ConfigField[]>("study.fields")));
  }, [all, link.value, study]);
  const name = String(study.presentation.device);
  const path = (dotted: string) => `/study/study/${dotted.replace(".", "/")}`;
  return (
    <Panel title="Presentation" actions={<Button kind="quiet" onClick={() => setAll(true)} testId="study-settings">All settings</Button>}>
      <Select
        label="Device"
        wide
        value={name}
        options={devices.filter((one) => one.name !== "replay").map((one) => ({ value: one.name, label: one.available ? one.title : `${one.title} (not set up)` }))}
        hint={devices.find((one) => one.name === name)?.words}
        onChange={(next) => attempt(() => edit("/study/study/presentation/device", next, `device ${next}`))}
        testId="study-device"
      />
      <NumberField label="Side of a tile" unit="mm" value={Number(study.presentation.tile_mm)} low={1} high={1000} onChange={(value) => attempt(() => edit("/study/study/presentation/tile_mm", value, "side of a tile"))} />
      <Dialog title="Settings of the study" open={all} onClose={() => setAll(false)}>
        <p>The rule of the staircase, and how textures are presented. All other rendering settings are those given when the studio started.</p>
        <ConfigForm
          fields={fields}
          onChange={(dotted, text) => {
            const standard = fields.find((field) => field.path === dotted)?.default;
            void attempt(() => edit(path(dotted), text === null ? standard : settingValue(text), text === null ? `reset ${dotted}` : `change ${dotted}`));
          }}
        />
      </Dialog>
    </Panel>
  );
}

/** The study as a file. */
export function FilePanel() {
  const { study } = studySection.value;
  const [replace, setReplace] = useState(false);
  const [typed, setTyped] = useState("");
  const read = async (name: string) => {
    if (name) await edit("/study/study", await call<Study>("study.read", { name }), `read ${name}`);
  };
  const write = async () => {
    const { name } = await call<{ name: string }>("study.write", { name: `${study.name}.study.json`, replace });
    setReplace(false);
    say(`The study is in ${name}.`);
  };
  return (
    <Panel title="File" collapsible>
      <FilePicker label="Read" kinds={["study"]} value="" onChange={(name) => attempt(() => read(name))} testId="study-read" />
      <TextField
        label="Name of the study"
        wide
        value={study.name}
        error={typed !== "" && !isStudyName(typed) ? "Only letters, digits, _ and -, at most 60." : ""}
        onInput={setTyped}
        onChange={(name) => attempt(() => setStudy("name", name, `name the study ${name}`))}
        testId="study-name"
      />
      <Toggle label="Replace an existing file" on={replace} onChange={setReplace} />
      <Button onClick={write} testId="study-write">
        Write {study.name}.study.json
      </Button>
    </Panel>
  );
}
