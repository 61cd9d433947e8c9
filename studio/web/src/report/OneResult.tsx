import { AccuracyPlot } from "../measured/AccuracyPlot";
import { ComplianceScatter } from "../measured/ComplianceScatter";
import { thinnedWords, type Measured } from "../measured/measured";
import { ProfilePlot } from "../measured/ProfilePlot";
import { SpectrumPlot } from "../measured/SpectrumPlot";
import { TrajectoryView } from "../measured/TrajectoryView";
import { WayPlot } from "../measured/WayPlot";
import { Drawing } from "./Drawing";

/** The plots and the path of one result, as the Process page shows them. */
export function OneResult({ measured }: { measured: Measured }) {
  const has = (array: string) => measured.array(array).length > 0;
  return (
    <>
      <Drawing title="Height" note={thinnedWords(measured.profile, "heights")} tall>
        <ProfilePlot measured={measured} what="height" />
      </Drawing>
      <Drawing title="Texture" note="The height after the high-pass.">
        <ProfilePlot measured={measured} what="texture" />
      </Drawing>
      <div class="report-pair">
        <Drawing title="Force">
          <WayPlot measured={measured} what="force" />
        </Drawing>
        <Drawing title="Speed">
          <WayPlot measured={measured} what="speed" />
        </Drawing>
      </div>
      {has("trajectory_p_m") && (
        <Drawing title="The tip's path" tall>
          <TrajectoryView measured={measured} />
        </Drawing>
      )}
      <div class="report-pair">
        <Drawing title="Spectrum of the texture">
          <SpectrumPlot measured={measured} />
        </Drawing>
        {has("compliance_force_N") && (
          <Drawing title="Compliance">
            <ComplianceScatter measured={measured} />
          </Drawing>
        )}
      </div>
      {has("compared_s_m") && (
        <Drawing title="Comparison with the truth">
          <AccuracyPlot measured={measured} />
        </Drawing>
      )}
    </>
  );
}
