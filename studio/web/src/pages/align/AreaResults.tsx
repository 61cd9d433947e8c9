import { go } from "../../app/go";
import { FiguresTable } from "../../measured/FiguresTable";
import { VerdictList } from "../../measured/VerdictList";
import { verdictWord } from "../../measured/verdicts";
import { call } from "../../net/connection";
import { Button } from "../../ui/Button";
import { FolderWriter } from "../../ui/FolderWriter";
import { Lamp } from "../../ui/Lamp";
import { Panel } from "../../ui/Panel";
import { chooseScene } from "../feel/feelChoices";
import { align } from "./alignState";
import { areaFigures, areaKey, resultOf } from "./area";
import { madeArea } from "./areaState";
import "../../measured/measured.css";

const kLamps = { valid: ["good", "Valid"], limited: ["warn", "Limited"], invalid: ["bad", "Invalid"] } as const;

/** The verdict on the area and its values, and writing. */
export function AreaResults() {
  const made = madeArea.value;
  if (!made) return <Panel title="Area" testId="align-area-result" grow><p class="empty">No area yet.</p></Panel>;
  const result = resultOf(made.block);
  const [state, word] = kLamps[verdictWord(result.verdicts)];
  return (
    <>
      <Panel title="Area" testId="align-area-result" grow>
        <div class="measured-verdict" role="status" data-testid="align-area-verdict">
          <Lamp state={state} word={word} />
          {result.verdicts.length > 0 && <VerdictList verdicts={result.verdicts} />}
        </div>
        {result.patch.apart.length > 0 && <p>Outside the patch of the others: {result.patch.apart.join(", ")}.</p>}
        <FiguresTable figures={areaFigures(result)} />
      </Panel>
      {result.trustworthy && <AreaWrite number={made.block.head.number} stale={made.key !== areaKey(align.value?.area)} />}
    </>
  );
}

interface Written {
  name: string;
  scene: string;
  files: string[];
  command: string;
}

/** Writes what `asperity area` writes. */
function AreaWrite({ number, stale }: { number: number; stale: boolean }) {
  const feel = async (scene: string) => {
    await chooseScene(scene);
    go("feel");
  };
  return (
    <Panel title="Write the area" testId="align-area-write">
      <FolderWriter
        folder="area"
        button="Write area"
        hint={stale ? "Make the area again first: scans or settings were changed." : "The scene with the area, area.json, and the height, normal and σ maps as images"}
        disabled={stale}
        write={(name, replace) => call<Written>("align.area_write", { name, replace, number })}
        buttonTestId="align-area-write-button"
        testId="align-area-written"
      >
        {(written) => (
          <>
            <p>Written to {written.name}, with {written.files.join(", ")}.</p>
            <Button onClick={() => feel(written.scene)}>Open in Feel</Button>
            <details>
              <summary>Command line for the same result</summary>
              <code class="align-command">{written.command}</code>
            </details>
          </>
        )}
      </FolderWriter>
    </Panel>
  );
}
