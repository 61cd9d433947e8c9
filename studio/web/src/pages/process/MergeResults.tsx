import { FiguresTable } from "../../measured/FiguresTable";
import { measuredOf } from "../../measured/measured";
import { Verdict } from "../../measured/Verdict";
import { call } from "../../net/connection";
import { Figure } from "../../ui/Figure";
import { Figures } from "../../ui/Figures";
import { FolderWriter } from "../../ui/FolderWriter";
import { Panel } from "../../ui/Panel";
import { merged } from "./mergeState";
import { agrees, gainOf, gainWords, mergeFigures, mergeKey, ratioWords, strokesOf } from "./merging";
import type { ProcessSection } from "./processing";

/** The verdict on the merge, what it gains, its values. */
export function MergeResults({ section }: { section: ProcessSection }) {
  const shown = merged.value;
  if (!shown) return <Panel title="Merge" testId="merge-result" grow><p class="empty">Not merged yet.</p></Panel>;
  const measured = measuredOf(shown.block);
  const used = strokesOf(shown.block).filter((stroke) => stroke.used).length;
  const gain = gainOf(shown.block);
  const ratio = ratioWords(shown.block.head.result.merge);
  return (
    <>
      <Panel title="Merge" testId="merge-result" grow>
        <Verdict measured={measured} />
        <Figures>
          <Figure label="Strokes merged" value={`${used} of ${strokesOf(shown.block).length}`} />
          {agrees(shown.block) && (
            <>
              <Figure label="Noise of one stroke, RMS" value={gain.stroke_noise_rms_m} factor={1e6} unit="µm" digits={3} hint="In the band of the alignment: the stated noise, or the noise by the strokes' differences where it is larger" />
              <Figure label="Noise of the merge, RMS" value={gain.merged_noise_rms_m} factor={1e6} unit="µm" digits={3} hint="In the same band" />
              <Figure label="Gain" value={gainWords(gain, used)} testId="merge-gain" />
              {ratio && <Figure label="Noise by differences" value={ratio} hint="Power of the strokes' differences over the stated power. Above 1, the strokes are offset sideways, or their stated noise is too small" />}
            </>
          )}
        </Figures>
        {agrees(shown.block) && <FiguresTable figures={mergeFigures(measured.figures)} />}
      </Panel>
      {agrees(shown.block) && <MergeWrite stale={shown.key !== mergeKey(section)} />}
    </>
  );
}

interface Written {
  folder: string;
  notes: string[];
}

/** Writes what `asperity merge` writes. */
function MergeWrite({ stale }: { stale: boolean }) {
  return (
    <Panel title="Write the merge" testId="merge-write">
      <FolderWriter
        folder="merged"
        button="Write merge"
        hint={stale ? "Merge again first: strokes or settings were changed." : "profile.csv, spectrum.csv, texture.json and result.json, as asperity merge writes them"}
        disabled={stale}
        write={(name, replace) => call<Written>("process.write_merge", { name, replace })}
        buttonTestId="merge-write-button"
        testId="merge-written"
      >
        {(written) => (
          <>
            <p>Written to {written.folder}.</p>
            {written.notes.map((note) => (
              <p key={note}>{note}</p>
            ))}
          </>
        )}
      </FolderWriter>
    </Panel>
  );
}
